#include "scene/faults.hpp"

#include <fstream>

namespace orrery::test {
namespace {

Fault fault_from(const Json& row) {
    Fault fault;
    fault.name = row.at("name");
    fault.at = row.at("at");
    if (row.contains("put")) fault.put = row.at("put");
    fault.severity = row.value("severity", "error") == "error" ? Severity::error : Severity::warning;
    fault.where = row.value("where", fault.at);
    fault.says = row.at("says").get<std::vector<std::string>>();
    fault.schema_sees_it = row.value("schema sees it", true);
    return fault;
}

}  // namespace

void PrintTo(const Fault& fault, std::ostream* stream) { *stream << fault.name; }

const std::vector<Fault>& faults() {
    static const std::vector<Fault> all = [] {
        std::ifstream stream(ORRERY_FAULTS_FILE);
        std::vector<Fault> rows;
        for (const Json& row : Json::parse(stream)) rows.push_back(fault_from(row));
        return rows;
    }();
    return all;
}

Json broken_world(const Fault& fault) {
    Json json = world();
    const Json::json_pointer at(fault.at);
    if (fault.put) {
        json[at] = *fault.put;
    } else {
        json[at.parent_pointer()].erase(at.back());
    }
    return json;
}

}  // namespace orrery::test
