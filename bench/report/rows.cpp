#include "bench/report/rows.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <nlohmann/json.hpp>
#include <set>
#include <stdexcept>

namespace orrery::bench {

namespace {

using Json = nlohmann::json;

/// What Google Benchmark writes beside our counters.
const std::set<std::string> not_ours = {"family_index", "per_family_instance_index",
                                        "repetitions",  "repetition_index",
                                        "threads",      "iterations",
                                        "real_time",    "cpu_time",
                                        "time_unit"};

void append_new(std::vector<std::string>& list, const std::string& name) {
    if (std::find(list.begin(), list.end(), name) == list.end()) list.push_back(name);
}

Row row_of(const Json& benchmark) {
    const std::string name = benchmark.at("name");
    if (benchmark.value("error_occurred", false))
        throw std::runtime_error(fmt::format("{}: {}", name, benchmark.value("error_message", "failed")));
    std::vector<std::string> parts{""};
    for (const char c : name) {
        if (c == '/')
            parts.emplace_back();
        else
            parts.back() += c;
    }
    if (parts.size() < 4) throw std::runtime_error(fmt::format("'{}' is not group/subject/what/variant", name));
    Row row{parts[0], parts[1], parts[2], parts[3], {}};
    for (const auto& [key, value] : benchmark.items())
        if (value.is_number() && !not_ours.contains(key)) row.counters[key] = value;
    return row;
}

bool faster(const Row& a, const Row& b) {
    if (a.counters.contains("seconds")) return a["seconds"] < b["seconds"];
    const char* rate = a.counters.contains("Rays/s") ? "Rays/s" : "Operations/s";
    return a[rate] > b[rate];
}

}  // namespace

double Row::operator[](const std::string& counter) const {
    const auto found = counters.find(counter);
    return found == counters.end() ? 0 : found->second;
}

const Row* Results::find(std::string_view group, std::string_view subject, std::string_view what,
                         std::string_view variant) const {
    for (const Row& row : rows)
        if (row.group == group && row.subject == subject && row.what == what && row.variant == variant) return &row;
    return nullptr;
}

std::vector<std::string> Results::subjects(std::string_view group) const {
    std::vector<std::string> list;
    for (const Row& row : rows)
        if (row.group == group) append_new(list, row.subject);
    return list;
}

std::vector<std::string> Results::whats(std::string_view group, std::string_view subject) const {
    std::vector<std::string> list;
    for (const Row& row : rows)
        if (row.group == group && row.subject == subject) append_new(list, row.what);
    return list;
}

Results read_results(std::string_view text) {
    try {
        const Json json = Json::parse(text);
        const Json& context = json.at("context");
        Results results{context.value("cpu", "unknown processor"),
                        context.value("embree", "none"),
                        context.value("whole", "no") == "yes",
                        {}};
        std::vector<std::pair<std::size_t, Row>> rows;  // by place in the order of registration
        for (const Json& benchmark : json.at("benchmarks")) {
            if (benchmark.value("run_type", "iteration") != "iteration") continue;
            Row row = row_of(benchmark);
            const std::size_t place = benchmark.at("family_index");
            const auto same =
                std::find_if(rows.begin(), rows.end(), [&](const auto& other) { return other.first == place; });
            if (same == rows.end())
                rows.emplace_back(place, std::move(row));
            else if (faster(row, same->second))
                same->second = std::move(row);
        }
        std::sort(rows.begin(), rows.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
        for (auto& [place, row] : rows) results.rows.push_back(std::move(row));
        return results;
    } catch (const Json::exception& fault) {
        throw std::runtime_error(fmt::format("not a result of Google Benchmark: {}", fault.what()));
    }
}

std::string csv_of(const Results& results) {
    std::set<std::string> columns;
    for (const Row& row : results.rows)
        for (const auto& [name, value] : row.counters) columns.insert(name);
    std::string csv = "group,subject,what,variant";
    for (const std::string& column : columns) csv += "," + column;
    csv += "\n";
    for (const Row& row : results.rows) {
        csv += fmt::format("{},{},{},{}", row.group, row.subject, row.what, row.variant);
        for (const std::string& column : columns)
            csv += row.counters.contains(column) ? fmt::format(",{:.5g}", row[column]) : ",";
        csv += "\n";
    }
    return csv;
}

std::string file_name_of(std::string_view cpu) {
    std::string words;
    for (std::size_t i = 0; i < cpu.size(); ++i) {
        if (cpu[i] == '(') {  // (R), (TM)
            const std::size_t end = cpu.find(')', i);
            i = end == std::string_view::npos ? cpu.size() : end;
            continue;
        }
        const auto c = static_cast<unsigned char>(cpu[i]);
        words += std::isalnum(c) || c == '.' ? static_cast<char>(std::tolower(c)) : ' ';
    }
    std::string name, word;
    words += ' ';
    for (const char c : words) {
        if (c != ' ') {
            word += c;
            continue;
        }
        if (!word.empty() && word != "processor" && word != "cpu") name += (name.empty() ? "" : "-") + word;
        word.clear();
    }
    return name.empty() ? "unknown" : name;
}

}  // namespace orrery::bench
