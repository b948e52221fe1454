#include "gallery/entries.hpp"

#include <array>

namespace orrery {

namespace {

constexpr std::string_view showcase = "The showcase";
constexpr std::string_view depth = "Distance images";
constexpr std::string_view whitted = "Whitted ray tracing, two tone mappers";
constexpr std::string_view paths = "Path tracing, two image estimators";
constexpr std::string_view ground = "A ball of radius 1 on a ground of radius 10,000,000: where float ends";
constexpr std::string_view transports = "Naive against next event estimation against both, at equal samples";

constexpr auto entries = std::to_array<GalleryEntry>({
    {showcase, "As the scene file says", "still_life.png", "showcase.json"},

    {depth, "Scene 1", "depth_01.png", "assignment_01.json --integrator depth --size 320x320 --spp 64"},
    {depth, "Scene 8", "depth_08.png", "assignment_08.json --integrator depth --size 320x320 --spp 64"},

    {whitted, "Scene 1, sigmoid", "assignment_01_sigmoid.png", "assignment_01.json --size 320x320 --tonemap sigmoid"},
    {whitted, "Scene 1, linear", "assignment_01_linear.png", "assignment_01.json --size 320x320 --tonemap linear"},
    {whitted, "Scene 2, sigmoid", "assignment_02_sigmoid.png", "assignment_02.json --size 320x320 --tonemap sigmoid"},
    {whitted, "Scene 2, linear", "assignment_02_linear.png", "assignment_02.json --size 320x320 --tonemap linear"},
    {whitted, "Scene 7, sigmoid", "assignment_07_sigmoid.png", "assignment_07.json --size 320x320 --tonemap sigmoid"},
    {whitted, "Scene 7, linear", "assignment_07_linear.png", "assignment_07.json --size 320x320 --tonemap linear"},

    {paths, "Scene 3, uniform", "assignment_03_uniform.png",
     "assignment_03.json --size 320x320 --spp 256 --estimator uniform"},
    {paths, "Scene 3, stratified", "assignment_03_stratified.png",
     "assignment_03.json --size 320x320 --spp 256 --estimator stratified"},
    {paths, "Scene 4, uniform", "assignment_04_uniform.png",
     "assignment_04.json --size 320x320 --spp 256 --estimator uniform"},
    {paths, "Scene 4, stratified", "assignment_04_stratified.png",
     "assignment_04.json --size 320x320 --spp 256 --estimator stratified"},
    {paths, "Scene 5, uniform", "assignment_05_uniform.png",
     "assignment_05.json --size 320x320 --spp 256 --estimator uniform"},
    {paths, "Scene 5, stratified", "assignment_05_stratified.png",
     "assignment_05.json --size 320x320 --spp 256 --estimator stratified"},
    {paths, "Scene 6, uniform", "assignment_06_uniform.png",
     "assignment_06.json --size 320x320 --spp 256 --estimator uniform"},
    {paths, "Scene 6, stratified", "assignment_06_stratified.png",
     "assignment_06.json --size 320x320 --spp 256 --estimator stratified"},
    {paths, "Scene 8, uniform", "assignment_08_uniform.png",
     "assignment_08.json --size 320x320 --spp 256 --estimator uniform"},
    {paths, "Scene 8, stratified", "assignment_08_stratified.png",
     "assignment_08.json --size 320x320 --spp 256 --estimator stratified"},

    {transports, "Scene 8, naive", "transport_08_naive.png",
     "assignment_08.json --size 240x240 --spp 64 --transport naive"},
    {transports, "Scene 8, nee", "transport_08_nee.png", "assignment_08.json --size 240x240 --spp 64 --transport nee"},
    {transports, "Scene 8, mis", "transport_08_mis.png", "assignment_08.json --size 240x240 --spp 64 --transport mis"},
    {transports, "Scene 6, naive", "transport_06_naive.png",
     "assignment_06.json --size 240x240 --spp 64 --transport naive"},
    {transports, "Scene 6, nee", "transport_06_nee.png", "assignment_06.json --size 240x240 --spp 64 --transport nee"},
    {transports, "Scene 6, mis", "transport_06_mis.png", "assignment_06.json --size 240x240 --spp 64 --transport mis"},

    {ground,
     "float: shadows are clean, without acne or leaks, but numbers are 1 apart at the ground, which stands half a unit "
     "too high; `render` warns of it",
     "large_ground_float.png", "large_ground.json --size 360x240 --spp 256 --precision float"},
    {ground, "double: the balls stand on it, and glass has its caustic", "large_ground_double.png",
     "large_ground.json --size 360x240 --spp 256 --precision double"},
});

}  // namespace

std::span<const GalleryEntry> gallery() { return entries; }

}  // namespace orrery
