#include "bench/tradeoff/variants.hpp"

#include <algorithm>
#include <cmath>

#include "cli/words.hpp"

namespace orrery::tradeoff {

namespace {

/// The choices an option offers, without the default.
using Option = std::vector<Choice>;

/// An option of RenderSettings: every word of its table that is not the default.
template <auto field, const auto& words>
Option setting(const char* option) {
    Option choices;
    for (std::size_t i = 0; i < words.size(); ++i) {
        if (words[i].value == RenderSettings{}.*field) continue;
        const auto choose = [](Setup& setup, std::size_t word) { setup.settings.*field = words[word].value; };
        choices.push_back({option, std::string(words[i].text), choose, i});
    }
    return choices;
}

/// Options that say how light is sampled: their effects depend on each other, so that all combinations are tried.
std::vector<Option> crossed_options() {
    return {setting<&RenderSettings::transport, transport_words>("--transport"),
            setting<&RenderSettings::light_sampling, light_sampling_words>("--light-sampling"),
            setting<&RenderSettings::estimator, estimator_words>("--estimator")};
}

Option isas() {
    Option choices;
    for (const Isa isa : all_isas) {
        if (!isa_supported(isa) || isa == best_isa()) continue;
        const auto choose = [](Setup& setup, std::size_t word) { setup.isa = all_isas[word]; };
        choices.push_back({"--isa", std::string(isa_name(isa)), choose, static_cast<std::size_t>(isa)});
    }
    return choices;
}

Option roulette_from() {
    Option choices;
    for (const std::uint32_t from : {0u, 4u}) {
        const auto choose = [](Setup& setup, std::size_t n) {
            setup.settings.roulette_from = static_cast<std::uint32_t>(n);
        };
        choices.push_back({"--roulette-from", std::to_string(from), choose, from});
    }
    return choices;
}

/// Options that are tried one by one.
std::vector<Option> single_options() {
    const auto evenly = [](Setup& setup, std::size_t) { setup.taking = Taking::in_passes; };
    const auto adaptively = [](Setup& setup, std::size_t) { setup.taking = Taking::adaptively; };
    return {setting<&RenderSettings::light_choice, light_choice_words>("--light-choice"),
            setting<&RenderSettings::roulette, switch_words>("--roulette"),
            roulette_from(),
            isas(),
            setting<&RenderSettings::precision, precision_words>("--precision"),
            {{"--adaptive", "off", evenly, 0}, {"--adaptive", "on", adaptively, 0}}};
}

}  // namespace

Setup Variant::setup(const RenderSettings& usual) const {
    Setup setup{.settings = usual};
    for (const Choice& choice : choices) choice.choose(setup, choice.index);
    return setup;
}

std::string Variant::name() const {
    std::string name;
    for (const Choice& choice : choices) name += (name.empty() ? "" : " ") + choice.option + " " + choice.word;
    return name.empty() ? "defaults" : name;
}

bool Variant::chooses(const std::string& option) const {
    return std::ranges::any_of(choices, [&](const Choice& choice) { return choice.option == option; });
}

std::vector<Variant> all_variants() {
    std::vector<Variant> variants = {{}};
    for (const Option& option : crossed_options()) {
        const std::size_t before = variants.size();
        for (const Choice& choice : option) {
            for (std::size_t i = 0; i < before; ++i) {
                Variant variant = variants[i];
                variant.choices.push_back(choice);
                variants.push_back(std::move(variant));
            }
        }
    }
    for (const Option& option : single_options())
        for (const Choice& choice : option) variants.push_back({{choice}});
    return variants;
}

RenderSettings usual_settings(const RenderSettings& of_scene, double pixels) {
    RenderSettings usual;
    usual.integrator = of_scene.integrator;
    usual.depth = of_scene.depth;
    const double shape = static_cast<double>(of_scene.width) / of_scene.height;
    usual.width = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(pixels * shape))));
    usual.height = static_cast<std::uint32_t>(std::max(1.0, std::round(std::sqrt(pixels / shape))));
    return usual;
}

}  // namespace orrery::tradeoff
