#include "scene/json_text.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

#include "scene/printable.hpp"

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

/// Builds the value from the parser's events. The library's own builder neither sees repeated keys nor limits nesting,
/// and its callback variant rescans the parent after every child, which is quadratic in the length of a list.
class Builder final : public nlohmann::json_sax<Json> {
public:
    Builder(std::string_view text, Report& report) : text_(text), report_(report) {}

    Json take() { return std::move(root_); }

    bool null() override { return put(nullptr); }
    bool boolean(bool value) override { return put(value); }
    bool number_integer(number_integer_t value) override { return put(value); }
    bool number_unsigned(number_unsigned_t value) override { return put(value); }
    bool number_float(number_float_t value, const string_t&) override { return put(value); }
    bool string(string_t& value) override { return put(std::move(value)); }
    bool binary(binary_t&) override { return false; }  // not a part of JSON text
    bool start_object(std::size_t) override { return open(Json::object()); }
    bool start_array(std::size_t) override { return open(Json::array()); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& name) override {
        auto& members = *open_.back()->get_ptr<Json::object_t*>();
        const auto [member, is_new] = members.try_emplace(std::move(name));
        keys_.back() = &*member;
        if (!is_new) report_.add(Severity::error, where(), "found this key a second time, expected it once per object");
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
    using Member = Json::object_t::value_type;

    /// Stores a value in the innermost open container and says where.
    Json* place(Json value) {
        if (open_.empty()) return &(root_ = std::move(value));
        if (auto* list = open_.back()->get_ptr<Json::array_t*>()) return &list->emplace_back(std::move(value));
        return &(keys_.back()->second = std::move(value));
    }

    bool put(Json value) {
        place(std::move(value));
        return true;
    }

    bool open(Json container) {
        if (open_.size() == deepest_nesting) {
            report_.add(
                Severity::error, where(),
                fmt::format("found more than {0} levels of lists and objects, expected at most {0}", deepest_nesting));
            return false;
        }
        open_.push_back(place(std::move(container)));
        keys_.push_back(nullptr);
        return true;
    }

    bool close() {
        open_.pop_back();
        keys_.pop_back();
        return true;
    }

    /// Pointer to the value being read.
    std::string where() const {
        std::string pointer;
        for (std::size_t i = 0; i < open_.size(); ++i) {
            const bool innermost = i + 1 == open_.size();
            if (keys_[i] != nullptr) {
                pointer += '/' + pointer_token(keys_[i]->first);
            } else {
                // The open child is the last element; inside the innermost list the next element is yet to come.
                pointer += fmt::format("/{}", innermost ? open_[i]->size() : open_[i]->size() - 1);
            }
        }
        return pointer;
    }

    std::string_view text_;
    Report& report_;
    Json root_;
    std::vector<Json*> open_;    ///< containers being filled, outermost first; a container never moves while open
    std::vector<Member*> keys_;  ///< the current member of each; null in a list
};

}  // namespace

std::optional<Json> parse_json(std::string_view text, Report& report) {
    // The library takes a NUL for the end of the text and would not look at what follows. No JSON holds one.
    if (const auto nul = text.find('\0'); nul != text.npos) {
        report.add(Severity::error, line_and_column(text, nul), "found a NUL byte, expected JSON text in UTF-8");
        return std::nullopt;
    }
    Builder builder(text, report);
    if (!Json::sax_parse(text.begin(), text.end(), &builder)) return std::nullopt;
    return builder.take();
}

}  // namespace orrery
