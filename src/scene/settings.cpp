#include "scene/settings.hpp"

#include <fmt/format.h>

#include <limits>

#include "scene/image_memory.hpp"
#include "system/memory.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

constexpr std::uint32_t largest_dimension = 65536;
constexpr std::uint32_t deepest_whitted = 20;  // two branches per hit: 2^20 rays per sample is as far as it goes
constexpr std::uint32_t any = std::numeric_limits<std::uint32_t>::max();

void read_dimensions(Fields& fields, RenderSettings& settings) {
    const auto dimensions = fields.integer_pair("dimensions", 1, largest_dimension);
    if (!dimensions) return;
    settings.width = (*dimensions)[0];
    settings.height = (*dimensions)[1];
    const auto fault = too_many_pixels(settings.width, settings.height, memory_limit());
    if (fault) fields.fault("dimensions", *fault);
}

void read_output(Fields& fields, const std::filesystem::path& folder, RenderSettings& settings) {
    if (!fields.has("output")) return;  // the command line may name it
    const std::optional<std::string_view> output = fields.text("output", "a file path");
    if (!output) return;
    // A path with a NUL would be cut there by the operating system, and another file written; with other control
    // characters it would be no name that anybody can see and type.
    if (output->empty() || !is_printable(*output)) {
        const char* expected = output->empty() ? "a file path" : "a file path without control characters";
        fields.fault("output", fmt::format("found {}, expected {}", in_quotes(*output), expected));
        return;
    }
    settings.output = (folder / *output).lexically_normal();
}

void read_roulette(Fields& fields, RenderSettings& settings) {
    if (!fields.has("roulette")) return;
    const auto node = fields.any("roulette", "\"on\" or \"off\"");
    if (node->value().is_boolean()) {
        settings.roulette = node->value().get<bool>();
    } else if (const auto word = fields.choice<bool>("roulette", {{"on", true}, {"off", false}})) {
        settings.roulette = *word;
    }
}

}  // namespace

RenderSettings read_settings(const Node& renderer, const std::filesystem::path& folder, Report& report) {
    RenderSettings settings;
    Fields fields(renderer, "a renderer object", report);
    const auto integrator = fields.choice<Integrator>(
        "type", {{"PT", Integrator::path_tracing}, {"WRT", Integrator::whitted}, {"DEPTH", Integrator::depth}});
    settings.integrator = integrator.value_or(Integrator::path_tracing);
    read_dimensions(fields, settings);
    settings.samples = fields.integer("samples", 1, any).value_or(1);
    settings.depth = fields.integer("depth", 0, integrator == Integrator::whitted ? deepest_whitted : any).value_or(0);
    read_output(fields, folder, settings);

    if (fields.has("estimator")) {
        const auto estimator = fields.choice<Estimator>(
            "estimator",
            {{"uniform", Estimator::uniform}, {"stratified", Estimator::stratified}, {"sobol", Estimator::sobol}});
        settings.estimator = estimator.value_or(settings.estimator);
    }
    if (fields.has("transport")) {
        const auto transport = fields.choice<Transport>(
            "transport", {{"naive", Transport::naive}, {"nee", Transport::nee}, {"mis", Transport::mis}});
        settings.transport = transport.value_or(settings.transport);
    }
    if (fields.has("light sampling")) {
        const auto sampling = fields.choice<LightSampling>(
            "light sampling", {{"area", LightSampling::area}, {"cone", LightSampling::cone}});
        settings.light_sampling = sampling.value_or(settings.light_sampling);
    }
    if (fields.has("light choice")) {
        const auto choice = fields.choice<LightChoice>(
            "light choice",
            {{"all", LightChoice::all}, {"uniform", LightChoice::uniform}, {"power", LightChoice::power}});
        settings.light_choice = choice.value_or(settings.light_choice);
    }
    read_roulette(fields, settings);
    if (fields.has("roulette from")) settings.roulette_from = fields.integer("roulette from", 0, any).value_or(0);
    if (fields.has("tonemap")) {
        settings.tonemap = fields.choice<ToneMap>(
            "tonemap", {{"sigmoid", ToneMap::sigmoid}, {"linear", ToneMap::linear}, {"none", ToneMap::none}});
    }
    if (fields.has("seed")) settings.seed = fields.integer("seed", 0, any).value_or(0);
    fields.finish();
    return settings;
}

}  // namespace orrery
