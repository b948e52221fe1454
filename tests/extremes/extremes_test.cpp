// Every case of the suite, with its usual number of trials.
#include <gtest/gtest.h>

#include <algorithm>
#include <cctype>

#include "cases.hpp"

namespace orrery::extremes {

/// So that a failure names the case in words.
void PrintTo(const Case& c, std::ostream* out) { *out << full_name(c); }

namespace {

class Extremes : public testing::TestWithParam<Case> {};

TEST_P(Extremes, KeepsItsPromise) {
    const Case& c = GetParam();
    const Errors errors = errors_of(c, c.trials);
    EXPECT_GT(errors.count(), 0u);
    EXPECT_LE(errors.worst(), c.limit) << "in units of " << c.unit << ", by " << errors.culprit();
}

std::string name_of(const testing::TestParamInfo<Case>& info) {
    const Case& c = info.param;
    std::string name = c.group + " " + c.name + " " + c.mode;
    std::ranges::replace_if(
        name, [](unsigned char letter) { return std::isalnum(letter) == 0; }, '_');
    return name;
}

INSTANTIATE_TEST_SUITE_P(Of, Extremes, testing::ValuesIn(all_cases()), name_of);

}  // namespace
}  // namespace orrery::extremes
