#pragma once

#include "mis/engine/job.h"

namespace mis {

// The stages that know no policy, technique, BSDF or heuristic: rows, rays and sums. Instantiated
// for float and double.

/// One row per sample, in order: slot, point, n, wo.
template <class T> void start_rows(const TileJob<T>& job, Batch<T>& batch);

/// One-sample model: keeps the rows whose technique number falls to the light, or to the BSDF.
template <class T> void keep_light_rows(const TileJob<T>& job, Batch<T>& batch);
template <class T> void keep_bsdf_rows(const TileJob<T>& job, Batch<T>& batch);

/// wi → light, distance; keeps only the rows that meet a light.
template <class T> void meet_lights(const TileJob<T>& job, Batch<T>& batch);

/// light → radiance.
template <class T> void fetch_radiance(const TileJob<T>& job, Batch<T>& batch);

/// contribution = 0 where another light stands before the one drawn.
template <class T> void hide_by_lights(const TileJob<T>& job, Batch<T>& batch);

/// contribution = 0 where a surface stands before the light. Rows that are 0 already cost no ray.
template <class T> void hide_by_surfaces(const TileJob<T>& job, Batch<T>& batch);

}  // namespace mis
