#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>

#include "scene/json_tree_builder.hpp"
#include "scene/quick_json.hpp"
#include "system/printable.hpp"

namespace orrery {
namespace {

using Json = nlohmann::json;

/// "line:column" of a byte, both from 1. Columns count characters, as editors do: continuation bytes are not counted.
std::string line_and_column(std::string_view text, std::size_t byte) {
    const std::string_view before = text.substr(0, byte);
    const auto line = 1 + std::count(before.begin(), before.end(), '\n');
    const std::string_view same_line = before.substr(before.rfind('\n') + 1);  // npos + 1 is 0
    const auto column = 1 + std::count_if(same_line.begin(), same_line.end(),
                                          [](char c) { return (static_cast<unsigned char>(c) & 0xC0) != 0x80; });
    return fmt::format("{}:{}", line, column);
}

/// "[json.exception.parse_error.101] parse error at line 1, column 2: what" -> "what": we print the place ourselves.
std::string_view without_preamble(std::string_view what) {
    if (const auto bracket = what.find("] "); bracket != what.npos) what.remove_prefix(bracket + 2);
    constexpr std::string_view place = "parse error at line ";
    if (what.substr(0, place.size()) == place) {
        if (const auto colon = what.find(": "); colon != what.npos) what.remove_prefix(colon + 2);
    }
    return what;
}

/// Names the faults. This parser says what it found and what it expected, and it takes four times as long as the quick
/// one: it reads what that one refused.
class Explainer final : public nlohmann::json_sax<Json> {
public:
    Explainer(std::string_view text, Report& report) : text_(text), report_(report) {}

    JsonTree take() { return builder_.take(); }

    bool null() override { return builder_.null(), true; }
    bool boolean(bool value) override { return builder_.boolean(value), true; }
    bool number_integer(number_integer_t value) override { return builder_.negative(value), true; }
    bool number_unsigned(number_unsigned_t value) override { return builder_.natural(value), true; }
    bool number_float(number_float_t value, const string_t&) override { return builder_.real(value), true; }
    bool string(string_t& value) override { return builder_.text(value), true; }
    bool binary(binary_t&) override { return false; }  // not a part of JSON text
    bool start_object(std::size_t) override { return builder_.open_object() || too_deep(); }
    bool start_array(std::size_t) override { return builder_.open_list() || too_deep(); }
    bool end_object() override { return builder_.close(), true; }
    bool end_array() override { return builder_.close(), true; }

    bool key(string_t& name) override {
        if (!builder_.key(name)) {
            report_.add(Severity::error, builder_.where(), "found this key a second time, expected it once per object");
        }
        return true;
    }

    bool parse_error(std::size_t position, const std::string& token,
                     const nlohmann::detail::exception& error) override {
        // `position` counts the bytes read, so the offending byte is the one before; past the end at the end of input.
        const std::size_t byte = std::min(position == 0 ? 0 : position - 1, text_.size());
        // What is no parse error is a number out of range, the one fault that is not of the grammar.
        std::string message = dynamic_cast<const Json::parse_error*>(&error) != nullptr
                                  ? printable(without_preamble(error.what()), 240)
                                  : fmt::format("found {}, expected a number that fits a double", printable(token));
        report_.add(Severity::error, line_and_column(text_, byte), std::move(message));
        return false;
    }

private:
    bool too_deep() {
        report_.add(
            Severity::error, builder_.where(),
            fmt::format("found more than {0} levels of lists and objects, expected at most {0}", deepest_nesting));
        return false;
    }

    std::string_view text_;
    Report& report_;
    JsonTreeBuilder builder_;
};

}  // namespace

std::optional<JsonTree> parse_json(std::string_view text, Report& report) {
    // The library takes a NUL for the end of the text and would not look at what follows. No JSON holds one.
    if (const auto nul = text.find('\0'); nul != text.npos) {
        report.add(Severity::error, line_and_column(text, nul), "found a NUL byte, expected JSON text in UTF-8");
        return std::nullopt;
    }
    // Versions of the library word this one differently.
    if (text.find_first_not_of(" \t\r\n") == text.npos) {
        report.add(Severity::error, line_and_column(text, text.size()),
                   "found the end of the text and nothing before it, expected a scene in JSON");
        return std::nullopt;
    }
    if (std::optional<JsonTree> tree = parse_quickly(text)) return tree;
    Explainer explainer(text, report);
    if (!Json::sax_parse(text.begin(), text.end(), &explainer)) return std::nullopt;
    return explainer.take();
}

}  // namespace orrery
