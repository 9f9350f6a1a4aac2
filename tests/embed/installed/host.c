/* A renderer in C99: a white floor under two lamps, by every policy and technique that it names, against the closed form. */
#include <mis/c.h>

#include <math.h>
#include <stdio.h>
#include <string.h>

static const float pi = 3.14159265f;

/* SplitMix64 (Steele, Lea and Flood 2014). */
static uint64_t next(void* self)
{
    uint64_t z = *(uint64_t*)self += 0x9e3779b97f4a7c15u;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
}
static float uniform(void* self) { return (float)(next(self) >> 40) * 0x1p-24f; }
static void numbers(void* self, int draw, mis_numbers* u)
{
    (void)draw;
    u->choice = next(self), u->technique = uniform(self), u->lobe = uniform(self);
    u->cap[0] = uniform(self), u->cap[1] = uniform(self);
    u->bsdf[0] = uniform(self), u->bsdf[1] = uniform(self);
}

static void evaluate(void* self, const float wi[3], float f[3])
{
    (void)self, (void)wi;
    f[0] = f[1] = f[2] = 1 / pi;
}
static float pdf(void* self, const float wi[3])
{
    (void)self;
    return wi[2] / pi;
}
static void sample(void* self, float lobe, const float u[2], float wi[3])
{
    const float r = sqrtf(u[0]), phi = 2 * pi * u[1];
    (void)self, (void)lobe;
    wi[0] = r * cosf(phi), wi[1] = r * sinf(phi), wi[2] = sqrtf(1 - u[0]);
}
static int is_occluded(void* self, const float wi[3], float distance)
{
    (void)wi;
    ++*(int*)self;
    return distance < 0;
}

static const mis_light lamps[2] = {{{0, 0, 4}, 0.5, {10, 10, 10}}, {{3, 0, 2}, 0.1, {90, 60, 30}}};

/* Reflected radiance of the floor at the origin: L sin^2 theta_max cos beta, summed. */
static double exact(void)
{
    double sum = 0;
    int j;
    for (j = 0; j < 2; ++j) {
        const mis_light* l = &lamps[j];
        const double d2 = l->center[0] * l->center[0] + l->center[2] * l->center[2];
        sum += l->radiance[0] * l->radius * l->radius / d2 * l->center[2] / sqrt(d2);
    }
    return sum;
}

static int failures;
static void expect(int holds, const char* what)
{
    if (holds) return;
    printf("does not hold: %s\n", what);
    ++failures;
}

/* Mean of 20000 samples within 5 standard errors: a false alarm once in 1.7 million. */
static void try_strategy(const char* name)
{
    const double x[3] = {0, 0, 0};
    const float n[3] = {0, 0, 1};
    const int samples = 20000;
    uint64_t state = 1;
    int rays_cast = 0, invalid = 0, k;
    double sum = 0, sum2 = 0, mean, error;
    char message[200];
    mis_lights* lights = 0;
    mis_point* point = 0;
    mis_bsdf bsdf = {0, evaluate, pdf, sample};
    mis_rays rays = {0, is_occluded};
    mis_random random = {0, numbers};
    rays.self = &rays_cast, random.self = &state;
    expect(mis_lights_create(name, lamps, 2, &lights, message, sizeof message) == MIS_OK, name);
    if (!lights) return;
    expect(mis_point_create(lights, &point) == MIS_OK, "a point is made");
    expect(mis_point_move_to(point, x, n) == 1, "it is lit");
    for (k = 0; k < samples; ++k) {
        float radiance[3];
        invalid += mis_point_sample(point, &bsdf, &rays, &random, radiance);
        sum += radiance[0], sum2 += (double)radiance[0] * radiance[0];
    }
    mean = sum / samples;
    error = sqrt((sum2 / samples - mean * mean) / samples) + 1e-6 * exact();
    printf("%-28s %.5f +- %.5f, exactly %.5f, %d rays\n", name, mean, error, exact(), rays_cast);
    expect(fabs(mean - exact()) < 5 * error, name);
    expect(invalid == 0 && rays_cast > 0, "all samples are finite, and rays are asked for");
    mis_point_destroy(point);
    mis_lights_destroy(lights);
}

static void try_mistakes(void)
{
    const mis_light flat = {{0, 0, 1}, -1, {1, 1, 1}};
    const double inside[3] = {0, 0, 4};
    const float n[3] = {0, 0, 1};
    double probability = 1;
    char message[200];
    mis_lights* lights = 0;
    mis_point* point = 0;
    expect(mis_lights_create("unifrom/light", lamps, 2, &lights, message, sizeof message) == MIS_BAD_STRATEGY &&
               strstr(message, "uniform") && !lights,
           "a name that is not known is refused, and the nearest offered");
    expect(mis_lights_create("brdf", lamps, 2, &lights, message, sizeof message) == MIS_BAD_STRATEGY, "brdf is refused");
    expect(mis_lights_create("uniform/light", &flat, 1, &lights, message, sizeof message) == MIS_BAD_LIGHT &&
               strstr(message, "light 0/radius"),
           "a negative radius is refused by name");
    expect(mis_lights_create(0, lamps, 2, &lights, 0, 0) == MIS_BAD_ARGUMENT, "a null name is refused");
    expect(mis_lights_create("uniform/light", 0, 0, &lights, 0, 0) == MIS_OK, "no lights at all are fine");
    expect(mis_point_create(lights, &point) == MIS_OK, "a point is made");
    mis_point_move_to(point, inside, n);
    expect(mis_point_choose(point, 7, &probability) == -1 && probability == 0, "nothing is chosen of nothing");
    expect(mis_lights_assign(lights, lamps, 2, 0, 0) == MIS_OK, "lights are added");
    expect(mis_point_move_to(point, inside, n) == 0, "a point inside a light is not lit");
    expect(mis_point_probability(point, 0) == 0, "and chooses nothing");
    expect(mis_lights_replace(lights, 2, &lamps[0], 0, 0) == MIS_BAD_ARGUMENT, "there is no third light");
    expect(mis_lights_replace(lights, 0, 0, 0, 0) == MIS_BAD_ARGUMENT, "a null light is refused");
    expect(mis_lights_replace(lights, 0, &flat, message, sizeof message) == MIS_BAD_LIGHT && strstr(message, "light 0/radius"),
           "a negative radius is refused here too");
    expect(mis_point_move_to(point, inside, n) == 0, "and the old light stays");
    {
        mis_light moved = lamps[0];
        moved.center[0] += 1000;
        expect(mis_lights_replace(lights, 0, &moved, 0, 0) == MIS_OK, "a light is moved");
        expect(mis_point_move_to(point, inside, n) == 1, "away from the point");
    }
    mis_point_destroy(point);
    mis_lights_destroy(lights);
}

int main(void)
{
    const char* names[] = {"irradiance/balance",    "power/light",          "uniform/power/union", "solid-angle/cutoff@2+1",
                           "all/maximum", "radiant-solid-angle/balance/one-sample"};
    size_t i;
    for (i = 0; i < sizeof names / sizeof *names; ++i) try_strategy(names[i]);
    try_mistakes();
    return failures ? 1 : 0;
}
