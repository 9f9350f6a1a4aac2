/** \file
 * mis for hosts in C and in languages that call C: direct lighting at a point from spherical
 * lights. The same engine as mis/engine/direct.h, with the strategy chosen by name at run time.
 * Lengths are in scene units, directions are unit vectors in scene axes, radiance is linear RGB in
 * W/(sr m^2), densities are per steradian. No global state; nothing is printed. What allocates:
 * *_create, *_assign, a *_replace that makes tables anew, and the first *_move_to after there are
 * more lights than ever before. Many threads may read a mis_lights that nobody changes; a mis_point
 * is one thread's. */
#ifndef MIS_BIND_C_H
#define MIS_BIND_C_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/** What calls return. */
typedef enum mis_status {
    MIS_OK = 0,
    MIS_BAD_ARGUMENT, /**< a null pointer */
    MIS_BAD_STRATEGY, /**< a name that is not known, or has no meaning here; `message` says why */
    MIS_BAD_LIGHT, /**< a radius or a radiance out of range; `message` says which light and why */
    MIS_NO_MEMORY  /**< nothing was made */
} mis_status;

/** Lights made ready for a strategy. */
typedef struct mis_lights mis_lights;
/** A shading point among them. */
typedef struct mis_point mis_point;

/** A sphere that shines outwards. */
typedef struct mis_light {
    double center[3];   /**< scene units */
    double radius;      /**< > 0 */
    double radiance[3]; /**< RGB */
} mis_light;

/** The host's BSDF at a point, for one direction to the viewer. */
typedef struct mis_bsdf {
    void* self; /**< handed back to every call */
    /** f, 1/sr, without the cosine */
    void (*evaluate)(void* self, const float wi[3], float f[3]);
    /** density of sample() */
    float (*pdf)(void* self, const float wi[3]);
    /** from numbers in [0, 1) */
    void (*sample)(void* self, float lobe, const float u[2], float wi[3]);
} mis_bsdf;

/** The host's shadow ray. */
typedef struct mis_rays {
    void* self; /**< handed back to every call */
    /** not 0 where a surface stands before `distance` along wi */
    int (*is_occluded)(void* self, const float wi[3], float distance);
} mis_rays;

/** The random numbers of a light draw and a BSDF draw. All but `choice` are in [0, 1). */
typedef struct mis_numbers {
    uint64_t choice; /**< 64 random bits */
    float technique; /**< which half draws, in the one-sample model; of draw 0 */
    float cap[2];    /**< where in the light's cap */
    float lobe;      /**< which lobe of the BSDF */
    float bsdf[2];   /**< where in the lobe */
} mis_numbers;

/** The host's random numbers. */
typedef struct mis_random {
    void* self; /**< handed back to every call */
    /** those of light draw and BSDF draw `draw` of a sample */
    void (*numbers)(void* self, int draw, mis_numbers* out);
} mis_random;

/** lights: copied; count may be 0. strategy: "irradiance/balance", "power/light",
 * "uniform/power/union@2+1" ...; those that choose no light but "brdf" are the host's own affair.
 * message: may be null; gets at most `capacity` bytes with the closing 0. */
mis_status mis_lights_create(const char* strategy, const mis_light* lights, size_t count,
                             mis_lights** out, char* message, size_t capacity);
/** Other lights. On failure the old ones stay. Points made before take it in by their next move. */
mis_status mis_lights_assign(mis_lights* lights, const mis_light* list, size_t count, char* message,
                             size_t capacity);
/** Another light in the place of light `index`; what it costs: docs/embedding.md, "Lights that
 * change". On failure the old one stays. Points made before take it in by their next move. */
mis_status mis_lights_replace(mis_lights* lights, size_t index, const mis_light* light,
                              char* message, size_t capacity);
/** After its points. */
void mis_lights_destroy(mis_lights* lights);

/** A point of one thread, which is nowhere yet. */
mis_status mis_point_create(const mis_lights* lights, mis_point** out);
/** Null is allowed. */
void mis_point_destroy(mis_point* point);

/** Not lit: a point inside a light, and one whose position or normal is not finite. Returns whether
 * it is lit. The policy `product` takes the surface for Lambertian here: it knows mis's own BSDFs
 * alone. */
int mis_point_move_to(mis_point* point, const double x[3], const float n[3]);
/** A light drawn by 64 random bits, and its probability; -1 and 0 where none can contribute. */
int32_t mis_point_choose(const mis_point* point, uint64_t bits, double* probability);
/** That of mis_point_choose() drawing this light. */
double mis_point_probability(const mis_point* point, int32_t light);
/** One sample: adds up its draws. Returns how many were not finite; they count as 0. */
int mis_point_sample(const mis_point* point, const mis_bsdf* bsdf, const mis_rays* rays,
                     const mis_random* random, float radiance[3]);

#ifdef __cplusplus
}
#endif
#endif
