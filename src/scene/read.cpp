#include "scene/read.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <new>
#include <optional>
#include <string>

#include "scene/composition.hpp"
#include "scene/json_text.hpp"
#include "scene/renderer.hpp"
#include "system/file_descriptor.hpp"
#include "system/links.hpp"
#include "system/memory.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

/// What a scene may hold as text. The tree of a scene takes nine times as much, of the densest text ("{},") 27 times;
/// large data is no business of JSON.
constexpr std::uint64_t largest_file = std::uint64_t{1} << 31;

Scene read_root(const Json& tree, const std::filesystem::path& file, const std::filesystem::path& folder,
                Report& report) {
    Scene scene;
    scene.file = file;
    const Node node(tree);
    Fields root(node, "an object with the keys cameras, materials, shapes, lights and scene", report);
    root.ignore("$schema");  // tells editors where the JSON Schema is
    const Registries registries = read_registries(root, find_references(tree), report);

    if (const auto composition = root.any("scene", "a scene object")) {
        Fields fields(*composition, "a scene object", report);
        read_composition(fields, registries, report, scene);
        if (const auto renderer = fields.any("renderer", "a renderer object")) {
            scene.settings = read_renderer(*renderer, folder, report);
        }
        fields.finish();
    }
    root.finish();
    return scene;
}

ReadResult resolved(const JsonTree& tree, const std::filesystem::path& file, const std::filesystem::path& folder,
                    Report& report) {
    std::optional<Scene> scene;
    if (tree) scene = read_root(*tree, file, folder, report);
    if (report.has_errors()) scene.reset();
    return {std::move(scene), report.take()};
}

/// Text that grows in place: the system moves pages of a large block, where a string would copy its bytes and hold them
/// twice meanwhile.
class Text {
public:
    Text() = default;
    ~Text() { std::free(begin_); }
    Text(const Text&) = delete;
    Text& operator=(const Text&) = delete;

    std::string_view view() const { return {begin_, size_}; }

    /// Room for so many bytes behind the text.
    char* room(std::size_t bytes) {
        if (bytes > capacity_ - size_) {
            const std::size_t capacity = std::max(size_ + bytes, capacity_ + capacity_ / 2);
            char* const begin = static_cast<char*>(std::realloc(begin_, capacity));
            if (begin == nullptr) throw std::bad_alloc();
            begin_ = begin;
            capacity_ = capacity;
        }
        return begin_ + size_;
    }
    /// What was put there is text.
    void grow(std::size_t bytes) { size_ += bytes; }

private:
    char* begin_ = nullptr;
    std::size_t size_ = 0, capacity_ = 0;
};

/// The bytes of a file, as far as they can be text. False where they cannot be had, which is reported.
bool read_text(const FileDescriptor& input, Text& text, Report& report) {
    const auto fail = [&](std::string message) {
        report.add(Severity::error, "", std::move(message));
        return false;
    };
    struct stat status = {};
    if (!input.is_open() || ::fstat(input.number(), &status) != 0)
        return fail(fmt::format("cannot open this file: {}", std::strerror(errno)));
    const std::uint64_t most = std::min(largest_file, memory_limit());
    constexpr std::size_t block = std::size_t{1} << 20;
    if (S_ISREG(status.st_mode)) {
        // A file may claim any size without taking it; what it would take to read it is known.
        const auto size = static_cast<std::uint64_t>(status.st_size);
        if (size > most) return fail(fmt::format("found {} bytes, expected a scene of at most {}", size, most));
        text.room(size + block);
    }
    for (;;) {
        char* const room = text.room(block);
        const ssize_t count = ::read(input.number(), room, block);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) return fail(fmt::format("cannot read this file: {}", std::strerror(errno)));
        text.grow(static_cast<std::size_t>(count));
        // No JSON holds a NUL, and what comes after one may never end. A reader must.
        if (count == 0 || std::memchr(room, 0, static_cast<std::size_t>(count)) != nullptr) return true;
        if (text.view().size() > most)
            return fail(fmt::format("found more than {} bytes, expected a scene of at most that", most));
    }
}

/// The tree has all there is in the text, which is gone on return: the scene takes its place in memory.
JsonTree parse_file(const std::filesystem::path& file, Report& report) {
    const FileDescriptor input(::open(file.c_str(), O_RDONLY | O_CLOEXEC));
    Text text;
    if (!read_text(input, text, report)) return nullptr;
    return parse_json(text.view(), report);
}

/// What a relative `output` starts from: the file's folder. A pipe has none, wherever its name is.
std::filesystem::path anchor(const std::filesystem::path& file) {
    std::error_code error;
    return std::filesystem::is_regular_file(file, error) && !means_open_file(file) ? file.parent_path() : "";
}

}  // namespace

std::string format_diagnostic(std::string_view file, const Diagnostic& diagnostic) {
    const std::string name = printable_whole(file);
    const char* severity = diagnostic.severity == Severity::error ? "error" : "warning";
    if (diagnostic.where.empty()) return fmt::format("{}: {}: {}", name, severity, diagnostic.message);
    return fmt::format("{}:{}: {}: {}", name, diagnostic.where, severity, diagnostic.message);
}

ReadResult read_scene_text(std::string_view text, const std::filesystem::path& file) {
    Report report;
    return resolved(parse_json(text, report), file, file.parent_path(), report);
}

ReadResult read_scene(const std::filesystem::path& file) {
    Report report;
    return resolved(parse_file(file, report), file, anchor(file), report);
}

}  // namespace orrery
