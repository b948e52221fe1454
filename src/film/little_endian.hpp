// Numbers to bytes and back, the lowest byte first, on any machine.
#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace orrery {

class LittleEndianWriter {
public:
    void u8(std::uint32_t x) { bytes_.push_back(static_cast<std::byte>(x)); }
    void u32(std::uint32_t x) { number(x); }
    void u64(std::uint64_t x) { number(x); }
    void f32(float x) { number(std::bit_cast<std::uint32_t>(x)); }
    void f64(double x) { number(std::bit_cast<std::uint64_t>(x)); }
    void text(std::string_view text) { append(std::as_bytes(std::span(text))); }
    void append(std::span<const std::byte> bytes) { bytes_.insert(bytes_.end(), bytes.begin(), bytes.end()); }

    const std::vector<std::byte>& bytes() const { return bytes_; }

private:
    template <class Number>
    void number(Number x) {
        const std::size_t at = bytes_.size();
        bytes_.resize(at + sizeof x);
        for (std::size_t i = 0; i < sizeof x; ++i) bytes_[at + i] = static_cast<std::byte>(x >> 8 * i & 0xff);
    }

    std::vector<std::byte> bytes_;
};

/// Beyond the end numbers are 0 and texts empty, and it is no longer good.
class LittleEndianReader {
public:
    explicit LittleEndianReader(std::span<const std::byte> bytes) : rest_(bytes) {}

    std::uint32_t u8() { return static_cast<std::uint32_t>(number<std::uint8_t>()); }
    std::uint32_t u32() { return number<std::uint32_t>(); }
    std::uint64_t u64() { return number<std::uint64_t>(); }
    float f32() { return std::bit_cast<float>(u32()); }
    double f64() { return std::bit_cast<double>(u64()); }
    std::string_view text(std::size_t length) {
        const auto bytes = take(length);
        return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
    }
    std::span<const std::byte> take(std::size_t count) {
        good_ = good_ && count <= rest_.size();
        const auto taken = rest_.first(good_ ? count : 0);
        rest_ = rest_.subspan(taken.size());
        return taken;
    }

    std::size_t left() const { return rest_.size(); }
    bool good() const { return good_; }

private:
    template <class Number>
    Number number() {
        std::uint64_t x = 0;
        const auto bytes = take(sizeof(Number));
        for (std::size_t i = 0; i < bytes.size(); ++i) x |= std::to_integer<std::uint64_t>(bytes[i]) << 8 * i;
        return static_cast<Number>(x);
    }

    std::span<const std::byte> rest_;
    bool good_ = true;
};

}  // namespace orrery
