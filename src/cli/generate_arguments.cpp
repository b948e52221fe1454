#include "cli/generate_arguments.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <limits>

#include "cli/help.hpp"
#include "cli/option.hpp"
#include "cli/values.hpp"

namespace orrery {
namespace {

/// As many as a scene file below the reader's limit has room for.
constexpr std::uint32_t most_spheres = 10'000'000;

constexpr const char* example =
    "Kinds: random (evenly in a ball), lattice (a cube of rows), cluster (dense knots, emptiness between), cosmos "
    "(spiral "
    "galaxies; radii follow a power law). Each frames itself, whatever the number.\n"
    "\n"
    "Example: a million spheres, and a look at them\n"
    "  {0} generate cosmos --spheres 1000000 -o cosmos.json\n"
    "  {0} render cosmos.json -o cosmos.png\n"
    "\n"
    "A file holds about 150 bytes a sphere, one shape and one primitive a line; it is written whole or not at all. "
    "Exit "
    "code: 0 written, 1 the work failed, 2 bad usage.";

}  // namespace

void add_generation(CLI::App& app, Generation& generation) {
    add_option(app, "KIND", fmt::format("{}", fmt::join(worlds::kind_names, "|")), "What world to make",
               [&](const std::string& text) {
                   generation.kind = static_cast<worlds::Kind>(parse_word(text, worlds::kind_names));
               })
        ->required()
        ->group("Scene");
    add_option(app, "--spheres", "N", "How many spheres, at most ten million",
               [&](const std::string& text) { generation.spheres = parse_integer(text, 1, most_spheres); })
        ->required()
        ->group("Scene");
    add_option(app, "--seed", "N",
               "Another seed is another world of its kind; the same one, the same file (default: 0)",
               [&](const std::string& text) {
                   generation.seed = parse_integer(text, 0, std::numeric_limits<std::uint32_t>::max());
               })
        ->group("Scene");
    add_option(app, "-o,--output", "FILE", "Scene file to write (default: -, standard output)",
               [&](const std::string& text) {
                   if (text != "-") generation.output = text;
               })
        ->group("Scene");
    app.footer(fmt::format(example, typed_command()));
}

}  // namespace orrery
