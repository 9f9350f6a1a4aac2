// The Python module `mis`. What it promises stands in python/mis.pyi, for people and type checkers;
// the docstrings here are what help() shows.
#include "mis/bind/python/arrays.h"
#include "mis/bind/python/work.h"
#include "mis/io/report_json.h"
#include "mis/io/scene_json.h"
#include "mis/run/watched.h"
#include "mis/strategy/names.h"

#include <pybind11/pybind11.h>
#include <pybind11/stl.h>
#include <pybind11/stl/filesystem.h>

#include <atomic>
#include <optional>

namespace py = pybind11;
using namespace py::literals;  // NOLINT: "name"_a

namespace mis::python {

namespace {

/// Throws what a signal's Python handler raises.
void raise_signals()
{
    const py::gil_scoped_acquire acquired;
    if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

/// What work(stop) gives, while other Python threads run. Ctrl-C sets `stop`
/// and is raised.
auto interruptible(const auto& work)
{
    std::atomic<bool> stop{false};
    std::optional<decltype(work(stop))> result;
    const py::gil_scoped_release released;
    watched([&] { result.emplace(work(stop)); }, raise_signals, stop);
    return std::move(*result);
}

using Resolution = std::optional<std::array<int, 2>>;

std::shared_ptr<const ReadyScene> made_ready(Scene scene, const Resolution& resolution,
                                             const StopToken& stop)
{
    if (resolution) {
        if (!scene.camera)
            throw ArgumentError("resolution: " + scene.file +
                                " has no camera, so it has no picture");
        for (const int n : *resolution)
            if (n < 1 || n > limits::resolution)
                throw ArgumentError("resolution: found " + std::to_string(n) +
                                    "; a resolution is (width, height), each from 1 to " +
                                    std::to_string(limits::resolution));
        scene.camera->resolution = *resolution;
    }
    return std::make_shared<const ReadyScene>(std::move(scene), stop);
}

std::shared_ptr<const ReadyScene> scene_of_file(const std::filesystem::path& file,
                                                const Resolution& resolution)
{
    return interruptible([&](const std::atomic<bool>& flag) {
        const StopToken stop(&flag);
        return made_ready(read_scene(file, stop), resolution, stop);
    });
}

std::shared_ptr<const ReadyScene> scene_of_dict(const py::dict& dict, const Resolution& resolution,
                                                const std::filesystem::path& folder)
{
    const auto text = py::module_::import("json").attr("dumps")(dict).cast<std::string>();
    return interruptible([&](const std::atomic<bool>& flag) {
        const StopToken stop(&flag);
        return made_ready(parse_scene(text, folder / "scene", stop), resolution, stop);
    });
}

py::array light_radiance(const ReadyScene& ready)
{
    std::vector<Vec3<double>> all;
    for (const Light& light : ready.scene.lights) all.push_back(radiance(light));
    const auto count = static_cast<py::ssize_t>(all.size());
    return array_of<double>(std::move(all), {count, py::ssize_t{3}});
}

void bind_scene(py::module_& m)
{
    using Ready = ReadyScene;
    const auto scene_of = [](py::handle self) -> const Ready& { return self.cast<const Ready&>(); };
    py::class_<Ready, std::shared_ptr<Ready>>(m, "Scene", R"(
A scene made ready to be lit: mis-scene/1 (docs/scene-format.md), from a file or a dict.
It never changes. Lengths are in scene units, radiance in W/(sr m²).)")
        .def(py::init([](const py::dict& source, const Resolution& resolution,
                         const std::filesystem::path& folder) {
                 return std::const_pointer_cast<Ready>(scene_of_dict(source, resolution, folder));
             }),
             "source"_a, py::kw_only(), "resolution"_a = py::none(), "folder"_a = ".", R"(
The scene that a dict says, as its JSON would.
resolution: (width, height) in place of the camera's. folder: where the files lie that it names.
Raises SceneError, a ValueError.)")
        .def(py::init([](const std::filesystem::path& source, const Resolution& resolution) {
                 return std::const_pointer_cast<Ready>(scene_of_file(source, resolution));
             }),
             "source"_a, py::kw_only(), "resolution"_a = py::none(), R"(
The scene of a file. resolution: (width, height) in place of the camera's.
Raises SceneError, a ValueError.)")
        .def_property_readonly("name", [](const Ready& r) { return r.scene.name; })
        .def_property_readonly(
            "resolution",
            [](const Ready& r) -> Resolution {
                if (!r.scene.camera) return std::nullopt;
                return r.scene.camera->resolution;
            },
            "(width, height) of its picture, pixels; None without a camera.")
        .def_property_readonly(
            "probes", [](const Ready& r) { return r.scene.probes.size(); }, "How many it has.")
        .def_property_readonly(
            "light_centers",
            [=](py::handle self) {
                const Lights& lights = scene_of(self).scene.lights;
                const double* const first = lights.empty() ? nullptr : &lights[0].center.x;
                return view_of<double>(lights, first, 3, self);
            },
            "Float64 array (lights, 3), scene units: a read-only view of the scene's own memory.")
        .def_property_readonly(
            "light_radii",
            [=](py::handle self) {
                const Lights& lights = scene_of(self).scene.lights;
                const double* const first = lights.empty() ? nullptr : &lights[0].radius;
                return view_of<double>(lights, first, 1, self);
            },
            "Float64 array (lights,), scene units: a read-only view of the scene's own memory.")
        .def_property_readonly("light_radiance", light_radiance,
                               "Float64 array (lights, 3), RGB, W/(sr m²).")
        .def("__repr__", [](const Ready& r) {
            return "<mis.Scene \"" + r.scene.name + "\", " + std::to_string(r.scene.lights.size()) +
                   " lights>";
        });
}

/// What render() gives: arrays over the run's own memory.
struct PictureArrays {
    py::array_t<float> radiance;
    py::array_t<double> variance;
    std::uint64_t invalid;
};

void bind_render(py::module_& m)
{
    py::class_<PictureArrays>(m, "Picture",
                              "What render() gives: arrays over the run's own memory.")
        .def_readonly("radiance", &PictureArrays::radiance,
                      "Float32 array (height, width, 3), linear RGB, W/(sr m²), from the top.")
        .def_readonly("variance", &PictureArrays::variance,
                      "Float64 array (height, width): of one sample's luminance, NaN where a pixel "
                      "shows no surface, or for one sample per pixel.")
        .def_readonly("invalid", &PictureArrays::invalid,
                      "Samples that were not finite; they count as 0.");
    m.def(
        "render",
        [](const ReadyScene& scene, const std::string& strategy, std::int64_t spp,
           std::uint64_t seed, const std::string& sampler, int threads) {
            Picture picture = interruptible([&](const std::atomic<bool>& stop) {
                return render(scene, strategy, spp, sampler, {seed, threads, &stop});
            });
            const py::ssize_t height = picture.image.height, width = picture.image.width;
            return PictureArrays{
                array_of<float>(std::move(picture.image.pixels), {height, width, py::ssize_t{3}}),
                array_of<double>(std::move(picture.variance), {height, width}), picture.invalid};
        },
        "scene"_a, "strategy"_a, "spp"_a = 64, py::kw_only(), "seed"_a = 1,
        "sampler"_a = "independent", "threads"_a = 0, R"(
The picture of a scene by one strategy, `spp` samples at every pixel: what `mis render` writes.
sampler: "independent" or "sobol". threads: 0 takes as many as the machine has; the picture does
not depend on it. Other Python threads run meanwhile; Ctrl-C ends it.
Raises StrategyError and ValueError for arguments that have no meaning.)");
}

void bind_figures(py::module_& m)
{
    m.def(
        "samples",
        [](const ReadyScene& scene, const std::string& strategy, std::int64_t count,
           std::optional<std::int64_t> probe, std::optional<std::array<std::int64_t, 2>> pixel,
           std::int64_t first, std::uint64_t seed, const std::string& sampler, int threads) {
            if (probe && pixel)
                throw ArgumentError("probe and pixel: found both; name one of them");
            const Place place = pixel ? Place(*pixel) : Place(probe.value_or(0));
            auto values = interruptible([&](const std::atomic<bool>& stop) {
                return samples(scene, strategy, place, count, first, sampler,
                               {seed, threads, &stop});
            });
            return array_of<double>(std::move(values), {static_cast<py::ssize_t>(count)});
        },
        "scene"_a, "strategy"_a, "count"_a, py::kw_only(), "probe"_a = py::none(),
        "pixel"_a = py::none(), "first"_a = 0, "seed"_a = 1, "sampler"_a = "independent",
        "threads"_a = 0, R"(
Single samples at one shading point: float64 array (count,) of luminances, W/(sr m²), of the
samples numbered from `first` on. Sample k is the same whatever count and threads are.
sampler: "independent" or "sobol", one scrambling.
probe: its number in the scene (0 where nothing is said); or pixel: (column, row) from the top left.
All are 0 where no light can be seen. Raises StrategyError and ValueError.)");

    m.def(
        "compare",
        [](const ReadyScene& scene, const std::vector<std::string>& strategies,
           std::optional<std::int64_t> spp, std::optional<double> seconds,
           std::optional<double> error, double at, std::uint64_t seed, const std::string& sampler,
           int threads) {
            const CompareOptions options{spp, seconds, error, at, sampler};
            const std::string text = interruptible([&](const std::atomic<bool>& stop) {
                Report report = compare(scene, strategies, options, {seed, threads, &stop});
                report.command = "mis.compare";
                return report_json(report);
            });
            return py::module_::import("json").attr("loads")(text).cast<py::dict>();
        },
        "scene"_a, "strategies"_a, py::kw_only(), "spp"_a = py::none(), "seconds"_a = py::none(),
        "error"_a = py::none(), "at"_a = 16.0, "seed"_a = 1, "sampler"_a = "independent",
        "threads"_a = 0, R"(
Ranks strategies by variance and by efficiency: the dict of mis-report/1 (docs/report-format.md),
as `mis compare --json` writes it.
Until it is decided which to use and every ranked variance is known to 25 %, or 30 s; or for `spp`
samples per point, `seconds` of wall time, or until every ranked variance is known to ± `error` (a
share). at: samples per point that efficiency is for.
sampler: "independent"; or "sobol", which measures variances over scramblings of `at` samples each.
Raises StrategyError and ValueError.)");

    m.def(
        "predict",
        [](const ReadyScene& scene, const std::vector<std::string>& strategies, int threads) {
            const auto all = interruptible([&](const std::atomic<bool>& stop) {
                return predict(scene, strategies, {0, threads, &stop});
            });
            const auto named = [&](double Predicted::*member) {
                std::vector<double> column;
                for (const Predicted& one : all) column.push_back(one.*member);
                const auto count = static_cast<py::ssize_t>(strategies.size());
                return array_of<double>(std::move(column),
                                        {static_cast<py::ssize_t>(all.size()) / count, count});
            };
            return py::dict("mean"_a = named(&Predicted::mean),
                            "mean_error"_a = named(&Predicted::mean_error),
                            "variance"_a = named(&Predicted::variance),
                            "variance_error"_a = named(&Predicted::variance_error),
                            "fourth"_a = named(&Predicted::fourth),
                            "fourth_error"_a = named(&Predicted::fourth_error));
        },
        "scene"_a, "strategies"_a, py::kw_only(), "threads"_a = 0, R"(
What infinitely many samples would say at the scene's probes, by quadrature: a dict of float64
arrays (probes, strategies). "mean": luminance, W/(sr m²); "variance", "fourth": second and fourth
central moment of one sample's luminance; "mean_error", "variance_error", "fourth_error": bounds of
their errors.
Raises PredictError where a mesh or quad could hide a light from a probe; StrategyError and
ValueError.)");
}

std::vector<std::string> names_in(const std::vector<Choosable>& list)
{
    std::vector<std::string> names;
    for (const Choosable& one : list) names.push_back(one.name);
    return names;
}

}  // namespace

PYBIND11_MODULE(mis, m)
{
    m.doc() = R"(Direct lighting from many spheres, and which light-choice strategy to use for it.

    scene = mis.Scene("scenes/lecture.json")
    picture = mis.render(scene, "solid-angle/power", spp=16).radiance
    report = mis.compare(scene, ["uniform/light", "solid-angle/power"], seconds=2))";
    m.attr("__version__") = MIS_VERSION;
    // What each raises is a ValueError, with the message of the command line.
    py::register_exception<SceneError>(m, "SceneError", PyExc_ValueError);
    py::register_exception<StrategyError>(m, "StrategyError", PyExc_ValueError);
    py::register_exception<PredictError>(m, "PredictError", PyExc_ValueError);
    py::register_exception_translator([](std::exception_ptr thrown) {
        try {
            if (thrown) std::rethrow_exception(thrown);
        } catch (const ArgumentError& error) {
            PyErr_SetString(PyExc_ValueError, error.what());
        }
    });
    bind_scene(m);
    bind_render(m);
    bind_figures(m);
    m.def(
        "policies", [] { return names_in(policy_names()); }, "Names of all policies.");
    m.def(
        "heuristics", [] { return names_in(heuristic_names()); }, "Names of all heuristics.");
    m.def(
        "techniques", [] { return names_in(technique_names()); }, "Names of all techniques.");
}

}  // namespace mis::python
