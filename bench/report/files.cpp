#include "bench/report/files.hpp"

#include <fmt/format.h>

#include <fstream>
#include <span>
#include <sstream>
#include <stdexcept>

#include "image/atomic_file.hpp"

namespace fs = std::filesystem;

namespace orrery::bench {

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    std::ostringstream text;
    text << stream.rdbuf();
    if (!stream) throw std::runtime_error(fmt::format("cannot read {}", file.string()));
    return text.str();
}

void write_text(const fs::path& file, const std::string& text) {
    fs::create_directories(file.parent_path());
    write_atomically(file, std::as_bytes(std::span(text)));
}

}  // namespace orrery::bench
