#include "bench/tradeoff/variants.hpp"

#include <algorithm>
#include <cmath>

#include "scene/settings.hpp"

namespace orrery::tradeoff {

namespace {

/// The choices an option offers, without the default.
using Option = std::vector<Choice>;

/// Of a setting: every word that is not the default, or these numbers.
Option option_of(const Setting& setting, const std::vector<std::uint32_t>& numbers = {}) {
    Option choices;
    const auto add = [&](std::uint32_t value) {
        if (setting.member.get(RenderSettings{})[0] == value) return;
        const auto choose = [&setting, value](Setup& setup) { setting.member.set(setup.settings, {value}); };
        choices.push_back({"--" + std::string(setting.option), text_of(setting, {value}), choose});
    };
    for (std::uint32_t word = 0; word < setting.words.size(); ++word) add(word);
    for (const std::uint32_t number : numbers) add(number);
    return choices;
}

/// Settings that say how light is sampled: their effects depend on each other, so that all combinations are tried.
constexpr std::string_view crossed[] = {"transport", "light-sampling", "estimator"};

Option isas() {
    Option choices;
    for (const Isa isa : all_isas) {
        if (!isa_supported(isa) || isa == best_isa()) continue;
        choices.push_back({"--isa", std::string(isa_name(isa)), [isa](Setup& setup) { setup.isa = isa; }});
    }
    return choices;
}

/// Options that are tried one by one: all other settings that change no expectation, and what is no setting.
std::vector<Option> single_options() {
    const auto evenly = [](Setup& setup) { setup.taking = Taking::in_passes; };
    const auto adaptively = [](Setup& setup) { setup.taking = Taking::adaptively; };
    std::vector<Option> options;
    for (const Setting& setting : all_settings()) {
        if (!setting.same_expectation || std::ranges::count(crossed, setting.option) > 0) continue;
        const bool from = setting.option == "roulette-from";
        options.push_back(from ? option_of(setting, {0, 4}) : option_of(setting));
    }
    options.push_back(isas());
    options.push_back({{"--adaptive", "off", evenly}, {"--adaptive", "on", adaptively}});
    return options;
}

}  // namespace

Setup Variant::setup(const RenderSettings& usual) const {
    Setup setup{.settings = usual};
    for (const Choice& choice : choices) choice.choose(setup);
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
    for (const std::string_view name : crossed) {
        const std::size_t before = variants.size();
        for (const Choice& choice : option_of(setting(name))) {
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
