// The tables and plots of bench/README.md.
#pragma once

#include <map>
#include <string>
#include <string_view>

#include "bench/report/rows.hpp"

namespace orrery::bench {

/// Markdown, by the name of the block it belongs to: "setting", "machine", "renders", "peers", "stages", "builds".
std::map<std::string, std::string> blocks_of(const Results& results);

/// SVG, by file name.
std::map<std::string, std::string> plots_of(const Results& results);

/// Replaces what stands between `<!-- begin NAME -->` and `<!-- end NAME -->` by the block of that name; all else stays
/// as it is, so that prose survives. Throws std::runtime_error where a block has no place or a place no end.
std::string with_blocks(std::string page, const std::map<std::string, std::string>& blocks);

}  // namespace orrery::bench
