#include "scene/quick_json.hpp"

#include <rapidjson/memorystream.h>
#include <rapidjson/reader.h>

#include <charconv>
#include <cstdlib>
#include <cstring>
#include <new>
#include <utility>

#include "scene/json_tree_builder.hpp"

namespace orrery {
namespace {

/// RapidJSON's events, which stop at the first false.
class Handler {
public:
    JsonTree take() { return builder_.take(); }

    bool Null() { return builder_.null(), true; }
    bool Bool(bool value) { return builder_.boolean(value), true; }
    bool String(const char* text, std::size_t size, bool) { return builder_.text({text, size}), true; }
    bool Key(const char* text, std::size_t size, bool) { return builder_.key({text, size}); }
    bool StartObject() { return builder_.open_object(); }
    bool EndObject(std::size_t) { return builder_.close(), true; }
    bool StartArray() { return builder_.open_list(); }
    bool EndArray(std::size_t) { return builder_.close(), true; }

    /// The grammar has been checked; what the digits mean the standard library knows to the last bit.
    bool RawNumber(const char* text, std::size_t size, bool) {
        const std::string_view digits(text, size);
        const char* const end = text + size;
        if (digits.find_first_of(".eE") == digits.npos) {
            if (std::uint64_t natural; digits[0] != '-') {
                if (std::from_chars(text, end, natural).ec == std::errc()) return builder_.natural(natural), true;
            } else if (std::int64_t negative; std::from_chars(text, end, negative).ec == std::errc()) {
                return builder_.negative(negative), true;
            }
        }
        double real;
        if (std::from_chars(text, end, real).ec != std::errc()) return false;
        return builder_.real(real), true;
    }

    // Numbers come as RawNumber.
    bool Int(int) { return false; }
    bool Uint(unsigned) { return false; }
    bool Int64(std::int64_t) { return false; }
    bool Uint64(std::uint64_t) { return false; }
    bool Double(double) { return false; }

private:
    JsonTreeBuilder builder_;
};

/// RapidJSON goes on with a null pointer where its own allocator finds no memory.
struct Allocator {
    [[maybe_unused]] static constexpr bool kNeedFree = true;  // RapidJSON asks some allocators for it
    static void* existing(void* block) {
        if (block == nullptr) throw std::bad_alloc();
        return block;
    }
    void* Malloc(std::size_t size) { return size > 0 ? existing(std::malloc(size)) : nullptr; }
    void* Realloc(void* block, std::size_t, std::size_t size) {
        if (size > 0) return existing(std::realloc(block, size));
        Free(block);
        return nullptr;
    }
    static void Free(void* block) { std::free(block); }
};

bool is_ascii(std::string_view text) {
    std::uint64_t bits = 0;
    for (; text.size() >= 8; text.remove_prefix(8)) {
        std::uint64_t word;
        std::memcpy(&word, text.data(), 8);
        bits |= word;
    }
    for (const char c : text) bits |= static_cast<unsigned char>(c);
    return (bits & 0x8080808080808080) == 0;
}

template <unsigned flags>
std::optional<JsonTree> parse(std::string_view text) {
    rapidjson::MemoryStream stream(text.data(), text.size());
    rapidjson::GenericReader<rapidjson::UTF8<>, rapidjson::UTF8<>, Allocator> reader;
    Handler handler;
    if (!reader.Parse<flags | rapidjson::kParseNumbersAsStringsFlag>(stream, handler)) return std::nullopt;
    return handler.take();
}

}  // namespace

std::optional<JsonTree> parse_quickly(std::string_view text) {
    // RapidJSON lets half a surrogate pair pass, which only an escape can spell.
    if (text.find("\\u") != text.npos) return std::nullopt;
    // It looks at bytes one by one for UTF-8: a tenth of the time, which ASCII need not take.
    if (is_ascii(text)) return parse<rapidjson::kParseNoFlags>(text);
    return parse<rapidjson::kParseValidateEncodingFlag>(text);
}

}  // namespace orrery
