#include <fmt/format.h>

#include <algorithm>

#include "bench/tradeoff/output.hpp"

namespace orrery::tradeoff {

namespace {

/// What counts as a difference to a user, and how sure it has to be.
constexpr double worth = 1.05, standard_errors = 2;

bool better(const Figure& gain) { return gain.value > worth && gain.value - standard_errors * gain.error > 1; }
bool worse(const Figure& gain) { return better(ratio({1, 0}, gain)); }

std::string listed(const std::vector<std::string>& names) {
    std::string list;
    for (std::size_t i = 0; i < names.size(); ++i)
        list += (i == 0 ? "" : i + 1 == names.size() ? " and " : ", ") + names[i];
    return list;
}

/// "1.4 times", whichever way round is above one.
std::string times(double gain) { return fmt::format("{:.2g} times", std::max(gain, 1 / gain)); }

std::string verdict(const Outcome& outcome, const Effect& effect) {
    std::vector<std::string> gains, losses;
    for (std::size_t i = 0; i < effect.gains.size(); ++i) {
        const std::string scene =
            fmt::format("{} ({})", outcome.subjects[effect.subjects[i]].name, times(effect.gains[i].value));
        if (better(effect.gains[i])) gains.push_back(scene);
        if (worse(effect.gains[i])) losses.push_back(scene);
    }
    const Choice& choice = effect.choice;
    const std::string base = choice.instead_of.empty() ? "" : fmt::format(", against `{}`", choice.instead_of);
    const std::string option = fmt::format("* `{} {}`{}: ", choice.option, choice.word, base);
    if (gains.empty() && losses.empty()) return option + "no difference beyond the error bars.\n";
    if (gains.empty())
        return option + fmt::format("never. It is {} less efficient on average, and nowhere better.\n",
                                    times(effect.mean.value));
    if (losses.empty())
        return option + fmt::format("**better than {}** on {}, nowhere worse.\n",
                                    choice.instead_of.empty() ? "the default" : choice.instead_of, listed(gains));
    return option + fmt::format("for {}. Not for {}. On average it is {} {} efficient.\n", listed(gains),
                                listed(losses), times(effect.mean.value), effect.mean.value > 1 ? "more" : "less");
}

}  // namespace

std::string advice(const Outcome& outcome) {
    std::vector<std::string> kept, changed;
    for (std::size_t i = 0; i < outcome.subjects.size(); ++i) {
        const CellSummary &usual = outcome.defaults(i), &winner = best_of(outcome, i);
        const std::string& scene = outcome.subjects[i].name;
        if (better(ratio(winner.efficiency(), usual.efficiency())))
            changed.push_back(fmt::format("{} ({}, {})", scene, winner.name,
                                          times(ratio(winner.efficiency(), usual.efficiency()).value)));
        else
            kept.push_back(scene);
    }
    std::string text;
    if (!kept.empty())
        text += fmt::format(
            "Leave the defaults alone for {}: nothing measured is better by more than a twentieth, "
            "as far as the error bars tell.\n",
            listed(kept));
    if (!changed.empty()) text += fmt::format("Other settings are more efficient on {}.\n", listed(changed));
    text +=
        "\nOption by option, each instead of its default and alone. *Times more efficient* means that much less time "
        "for the same error:\n\n";
    bool any = false;
    for (const Effect& effect : effects_of(outcome)) {
        text += verdict(outcome, effect);
        any = any || (effect.choice.instead_of.empty() && better(effect.mean));
    }
    return text + (any ? "\nAn option above is better than its default on average: the default should change.\n"
                       : "\nNo option is better than its default on average over the scenes: the defaults stay.\n");
}

}  // namespace orrery::tradeoff
