// A folder of its own for each test.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "image/codec.hpp"

namespace orrery::test {

/// Made on construction, readable by all, removed with everything in it on destruction.
class TemporaryFolder {
public:
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }
    std::filesystem::path operator/(const char* name) const { return path_ / name; }

    /// The names of all entries, sorted, hidden ones included.
    std::vector<std::string> names() const;

private:
    std::filesystem::path path_;
};

Bytes to_bytes(std::string_view text);
std::string to_text(ByteView bytes);

/// Plain file access, not through what is tested.
void store(const std::filesystem::path& file, ByteView bytes);
std::string load(const std::filesystem::path& file);

}  // namespace orrery::test
