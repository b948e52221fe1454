// The words of the command line for the choices of RenderSettings and of worlds: one table each, for reading and for
// printing.
#pragma once

#include <array>
#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

#include "scene/scene.hpp"
#include "wavefront/goal.hpp"
#include "worlds/world.hpp"

namespace orrery {

template <class Value>
struct Word {
    std::string_view text;
    Value value;
};

template <class Value, std::size_t count>
using Words = std::array<Word<Value>, count>;

inline constexpr Words<Integrator, 3> integrator_words = {
    {{"pt", Integrator::path_tracing}, {"wrt", Integrator::whitted}, {"depth", Integrator::depth}}};
inline constexpr Words<Estimator, 3> estimator_words = {
    {{"uniform", Estimator::uniform}, {"stratified", Estimator::stratified}, {"sobol", Estimator::sobol}}};
inline constexpr Words<Transport, 3> transport_words = {
    {{"naive", Transport::naive}, {"nee", Transport::nee}, {"mis", Transport::mis}}};
inline constexpr Words<LightSampling, 2> light_sampling_words = {
    {{"area", LightSampling::area}, {"cone", LightSampling::cone}}};
inline constexpr Words<LightChoice, 3> light_choice_words = {
    {{"all", LightChoice::all}, {"uniform", LightChoice::uniform}, {"power", LightChoice::power}}};
inline constexpr Words<Precision, 3> precision_words = {
    {{"auto", Precision::automatic}, {"float", Precision::binary32}, {"double", Precision::binary64}}};
inline constexpr Words<bool, 2> switch_words = {{{"on", true}, {"off", false}}};
inline constexpr Words<ToneMap, 3> tonemap_words = {
    {{"sigmoid", ToneMap::sigmoid}, {"linear", ToneMap::linear}, {"none", ToneMap::none}}};

inline constexpr Words<worlds::Kind, 4> world_words = {{{"random", worlds::Kind::random},
                                                        {"lattice", worlds::Kind::lattice},
                                                        {"cluster", worlds::Kind::cluster},
                                                        {"cosmos", worlds::Kind::cosmos}}};

inline constexpr Words<StopReason, 3> stop_words = {
    {{"samples", StopReason::samples}, {"error", StopReason::error}, {"time", StopReason::time}}};

template <class Value, std::size_t count>
constexpr std::string_view word_for(const Words<Value, count>& words, Value value) {
    for (const auto& word : words)
        if (word.value == value) return word.text;
    return "?";
}

template <class Value, std::size_t count>
constexpr std::optional<Value> value_of(const Words<Value, count>& words, std::string_view text) {
    for (const auto& word : words)
        if (word.text == text) return word.value;
    return std::nullopt;
}

/// "pt|wrt|depth", as help and messages show a choice.
template <class Value, std::size_t count>
std::string alternatives(const Words<Value, count>& words) {
    std::string text;
    for (const auto& word : words) text += (text.empty() ? "" : "|") + std::string(word.text);
    return text;
}

}  // namespace orrery
