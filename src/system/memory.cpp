#include "system/memory.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <sstream>
#include <string>
#include <string_view>
#include <vector>

namespace orrery {
namespace {

namespace fs = std::filesystem;

constexpr std::uint64_t unlimited = std::numeric_limits<std::uint64_t>::max();

std::vector<std::string> parts(std::string_view text, char separator) {
    std::vector<std::string> list;
    std::string part;
    for (std::istringstream stream{std::string(text)}; std::getline(stream, part, separator);) list.push_back(part);
    return list;
}

bool has(const std::vector<std::string>& list, std::string_view word) {
    return std::ranges::find(list, word) != list.end();
}

/// A mounted hierarchy of groups that limit memory.
struct Hierarchy {
    bool unified;        ///< version 2
    std::string top;     ///< the group that is mounted
    std::string folder;  ///< where
};

/// Blanks in the paths of mountinfo are written in octal.
std::string without_octal(std::string_view text) {
    std::string plain;
    for (std::size_t i = 0; i < text.size(); ++i) {
        unsigned code = 0;
        const bool octal =
            text[i] == '\\' && i + 3 < text.size() &&
            std::from_chars(text.data() + i + 1, text.data() + i + 4, code, 8).ptr == text.data() + i + 4;
        plain += octal ? static_cast<char>(code) : text[i];
        i += octal ? 3 : 0;
    }
    return plain;
}

/// proc(5): "36 35 98:0 TOP FOLDER options [tag...] - TYPE source options"
std::vector<Hierarchy> hierarchies(const fs::path& root) {
    std::vector<Hierarchy> list;
    std::ifstream mounts(root / "proc/self/mountinfo");
    for (std::string line; std::getline(mounts, line);) {
        const std::vector<std::string> fields = parts(line, ' ');
        const auto dash = std::ranges::find(fields, "-");
        if (fields.size() < 6 || fields.end() - dash < 4) continue;
        const bool unified = dash[1] == "cgroup2";
        if (!unified && !(dash[1] == "cgroup" && has(parts(dash[3], ','), "memory"))) continue;
        list.push_back({unified, without_octal(fields[3]), without_octal(fields[4])});
    }
    return list;
}

std::optional<std::uint64_t> number_in(const fs::path& file) {
    std::string word;
    std::uint64_t number = 0;
    if (!(std::ifstream(file) >> word)) return std::nullopt;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), number);
    // What is no number is "max".
    return error == std::errc() && end == word.data() + word.size() ? std::optional(number) : std::nullopt;
}

/// The way down from the mounted group to `group`. Empty where that is not below it: the one is seen from the host, the
/// other from within a container, whose group is then the mounted one.
fs::path way_down(const Hierarchy& hierarchy, const std::string& group) {
    const std::string top = hierarchy.top == "/" ? "" : hierarchy.top;
    if (group.find("/..") != group.npos || !(group + '/').starts_with(top + '/')) return {};
    return fs::path(group.substr(top.size())).relative_path();
}

}  // namespace

std::optional<std::uint64_t> control_group_memory(const fs::path& root) {
    std::uint64_t least = unlimited;
    const std::vector<Hierarchy> mounted = hierarchies(root);
    std::ifstream groups(root / "proc/self/cgroup");
    // "4:memory:/group" or, version 2, "0::/group"
    for (std::string line; std::getline(groups, line);) {
        const std::size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == line.npos) continue;
        const std::string controllers = line.substr(first + 1, second - first - 1), group = line.substr(second + 1);
        if (!controllers.empty() && !has(parts(controllers, ','), "memory")) continue;
        for (const Hierarchy& hierarchy : mounted) {
            if (hierarchy.unified != controllers.empty()) continue;
            const fs::path top = root / fs::path(hierarchy.folder).relative_path();
            for (fs::path way = way_down(hierarchy, group);; way = way.parent_path()) {
                const auto limit = number_in(top / way / (hierarchy.unified ? "memory.max" : "memory.limit_in_bytes"));
                least = std::min(least, limit.value_or(unlimited));
                if (way.empty()) break;
            }
        }
    }
    return least != unlimited ? std::optional(least) : std::nullopt;
}

std::uint64_t memory_limit() {
    // The standard library does not know; sysconf is POSIX, and _SC_PHYS_PAGES is common to Linux, the BSDs and macOS.
    const long pages = ::sysconf(_SC_PHYS_PAGES);
    const long page_size = ::sysconf(_SC_PAGESIZE);
    const bool told = pages > 0 && page_size > 0;
    const std::uint64_t machine =
        told ? static_cast<std::uint64_t>(pages) * static_cast<std::uint64_t>(page_size) : unlimited;
    return std::min(machine, control_group_memory().value_or(unlimited));
}

void keep_within_memory() {
#if !defined(ORRERY_SANITIZED)  // a sanitizer reserves terabytes, and wants larger stacks
    rlimit limit = {};
    if (::getrlimit(RLIMIT_DATA, &limit) != 0 || memory_limit() >= limit.rlim_cur) return;
    limit.rlim_cur = memory_limit();
    ::setrlimit(RLIMIT_DATA, &limit);
    pthread_attr_t attributes;
    if (::pthread_attr_init(&attributes) != 0) return;
    ::pthread_attr_setstacksize(&attributes, std::size_t{1} << 20);
    ::pthread_setattr_default_np(&attributes);
    ::pthread_attr_destroy(&attributes);
#endif
}

}  // namespace orrery
