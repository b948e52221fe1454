#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

#include "system/printable.hpp"

namespace orrery {
namespace {

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

/// Empties lists and objects, the innermost first.
void clear(Json& value) noexcept {
    if (auto* const list = value.get_ptr<Json::array_t*>()) {
        for (Json& element : *list) clear(element);
        list->clear();
    } else if (auto* const object = value.get_ptr<Json::object_t*>()) {
        for (auto& [key, member] : *object) clear(member);
        object->clear();
    }
}

/// Builds the tree from the parser's events. The library's own builder knows neither repeated keys nor a limit to
/// nesting, and says where a fault is only in some of its messages.
class Builder final : public nlohmann::json_sax<Json> {
public:
    Builder(std::string_view text, Report& report) : text_(text), report_(report) {}

    JsonTree take() { return std::move(root_); }

    bool null() override { return put(nullptr), true; }
    bool boolean(bool value) override { return put(value), true; }
    bool number_integer(number_integer_t value) override { return put(value), true; }
    bool number_unsigned(number_unsigned_t value) override { return put(value), true; }
    bool number_float(number_float_t value, const string_t&) override { return put(value), true; }
    bool string(string_t& value) override { return put(std::move(value)), true; }
    bool binary(binary_t&) override { return false; }  // not a part of JSON text
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return open_.pop_back(), true; }
    bool end_array() override { return open_.pop_back(), true; }

    bool key(string_t& name) override {
        Open& object = open_.back();
        const auto [member, is_new] = object.value->get_ref<Json::object_t&>().try_emplace(std::move(name));
        object.key = &member->first;
        object.member = &member->second;
        if (!is_new) {
            report_.add(Severity::error, where(), "found this key a second time, expected it once per object");
            clear(member->second);
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
    /// A list or an object whose end has not come.
    struct Open {
        Json* value;
        const std::string* key = nullptr;  ///< object: of the member to come
        Json* member = nullptr;            ///< object: where that goes
    };

    /// Puts a value into the innermost list or object. Returns where it is: for as long as that gets no other.
    Json* put(Json value) {
        if (open_.empty()) return &(*root_ = std::move(value));
        if (Json* const member = open_.back().member) return &(*member = std::move(value));
        return &open_.back().value->emplace_back(std::move(value));
    }

    bool open(Json value) {
        if (open_.size() < deepest_nesting) return open_.push_back({put(std::move(value))}), true;
        report_.add(
            Severity::error, where(),
            fmt::format("found more than {0} levels of lists and objects, expected at most {0}", deepest_nesting));
        return false;
    }

    /// RFC 6901 pointer to the value to come.
    std::string where() const {
        std::string pointer;
        for (const Open& open : open_) {
            // The last element of an outer list is the next level; of the innermost it came before.
            const std::size_t elements = open.value->size() - (&open == &open_.back() ? 0 : 1);
            pointer += '/' + (open.key ? pointer_token(*open.key) : std::to_string(elements));
        }
        return pointer;
    }

    std::string_view text_;
    Report& report_;
    JsonTree root_{new Json};
    std::vector<Open> open_;  ///< outermost first
};

}  // namespace

void TakeDown::operator()(Json* root) const noexcept {
    clear(*root);
    delete root;
}

JsonTree parse_json(std::string_view text, Report& report) {
    // The library takes a NUL for the end of the text and would not look at what follows. No JSON holds one.
    if (const auto nul = text.find('\0'); nul != text.npos) {
        report.add(Severity::error, line_and_column(text, nul), "found a NUL byte, expected JSON text in UTF-8");
        return nullptr;
    }
    // Versions of the library word this one differently.
    if (text.find_first_not_of(" \t\r\n") == text.npos) {
        report.add(Severity::error, line_and_column(text, text.size()),
                   "found the end of the text and nothing before it, expected a scene in JSON");
        return nullptr;
    }
    Builder builder(text, report);
    if (!Json::sax_parse(text.begin(), text.end(), &builder)) return nullptr;
    return builder.take();
}

}  // namespace orrery
