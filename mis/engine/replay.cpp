#include "mis/engine/replay.h"

#include "mis/engine/light_columns.h"

#include <algorithm>
#include <memory>

namespace mis {

namespace {

template <class T>
ReplayStep step_after(StageKind stage, bool is_light_half, const TileJob<T>& job,
                      const Batch<T>& batch)
{
    const auto number = [](T x) { return static_cast<double>(x); };
    return {.is_light_half = is_light_half,
            .draw = batch.draw,
            .stage = stage,
            .is_alive = batch.rows > 0,
            .light = batch.light[0],
            .u = number(batch.u[0]),
            .v = number(batch.v[0]),
            .lobe = number(batch.lobe[0]),
            .probability = number(batch.probability[0]),
            .wi = vec_cast<double>(batch.wi.at(0)),
            .distance = number(batch.distance[0]),
            .light_pdf = number(batch.light_pdf[0]),
            .bsdf_pdf = number(batch.bsdf_pdf[0]),
            .contribution = vec_cast<double>(batch.contribution.at(0)) * job.radiance_unit};
}

/// Forgets the half before, so that what a step shows is of its own half.
template <class T> void clear_row(Batch<T>& batch)
{
    batch.light[0] = no_light;
    for (Column<T>* column : {&batch.u, &batch.v, &batch.lobe, &batch.probability, &batch.distance,
                              &batch.light_pdf, &batch.bsdf_pdf})
        (*column)[0] = T(0);
    batch.wi.put(0, Vec3<T>(T(0)));
    batch.contribution.put(0, Vec3<T>(T(0)));
}

}  // namespace

template <class T>
Replay replay(const LitScene& scene, const ReadyStrategy<T>& strategy, const Tile& tile,
              const ShadingPoint& point, std::uint64_t sample, const StopToken& stop)
{
    const Pipeline<T>& pipeline = strategy.pipeline(tile.material);
    TileJob<T> job = strategy.job(tile, {&point, 1});
    job.stop = &stop;
    const std::size_t lights = scene.scene().lights.size();
    LargeVector<T> columns;
    if (pipeline.reads_all_lights || lights <= most_screened_lights)
        job.columns =
            fill_light_columns(*job.lights, job.origin, columns, job.order, job.radiance_scale);
    const auto batch = std::make_unique<Batch<T>>();
    Scratch scratch(std::max<std::size_t>(pipeline.table_bytes, 1));
    batch->samples = 1;
    batch->points = 1;
    batch->sample_number[0] = sample;
    if (pipeline.prepare != nullptr) pipeline.prepare(job, *batch, 0, scratch);

    Replay found;
    const auto run_half = [&](const std::vector<NamedStage<T>>& stages, bool is_light_half,
                              std::uint32_t draw) {
        stop.check();
        batch->draw = draw;
        clear_row(*batch);
        for (const NamedStage<T>& stage : stages) {
            stage.run(job, *batch);
            found.steps.push_back(step_after(stage.kind, is_light_half, job, *batch));
            if (batch->rows == 0) return;
        }
    };
    const auto light_draws = static_cast<std::uint32_t>(
        static_cast<std::size_t>(pipeline.light_draws) * (pipeline.draws_every_light ? lights : 1));
    for (std::uint32_t draw = 0; draw < light_draws; ++draw) run_half(pipeline.light, true, draw);
    for (int draw = 0; draw < pipeline.bsdf_draws; ++draw)
        run_half(pipeline.bsdf, false, static_cast<std::uint32_t>(draw));
    const Vec3<double> value = batch->value.at(0) * job.radiance_unit;
    found.value = pipeline.colour ? value : Vec3<double>(value.x);
    return found;
}

template Replay replay(const LitScene&, const ReadyStrategy<float>&, const Tile&,
                       const ShadingPoint&, std::uint64_t, const StopToken&);
template Replay replay(const LitScene&, const ReadyStrategy<double>&, const Tile&,
                       const ShadingPoint&, std::uint64_t, const StopToken&);

}  // namespace mis
