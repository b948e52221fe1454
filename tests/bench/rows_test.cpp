#include "bench/report/rows.hpp"

#include <gmock/gmock.h>

#include <stdexcept>

#include "bench/report/page.hpp"
#include "bench/report/peers.hpp"

namespace orrery::bench {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

/// As Google Benchmark writes them: repetitions in random order, aggregates among them.
const std::string json = R"({
  "context": {"date": "x", "host_name": "secret", "cpu": "Some(R) CPU @ 2.50GHz", "embree": "3.13.5"},
  "benchmarks": [
    {"name": "peer/random-8/primary/embree-8/manual_time", "family_index": 3, "run_type": "iteration",
     "iterations": 7, "real_time": 1.0, "cpu_time": 1.0, "time_unit": "ns", "Rays/s": 2e7, "spheres": 8},
    {"name": "peer/random-8/primary/avx512/manual_time", "family_index": 2, "run_type": "iteration",
     "Rays/s": 1e8, "spheres": 8},
    {"name": "peer/random-8/primary/avx2/manual_time", "family_index": 1, "run_type": "iteration",
     "Rays/s": 0.6e8, "spheres": 8},
    {"name": "peer/random-8/primary/embree-16/manual_time", "family_index": 4, "run_type": "iteration",
     "Rays/s": 2.5e7, "spheres": 8},
    {"name": "peer/random-8/primary/avx512/manual_time", "family_index": 2, "run_type": "iteration",
     "Rays/s": 2e8, "spheres": 8},
    {"name": "peer/random-8/primary/avx512/manual_time_mean", "family_index": 2, "run_type": "aggregate",
     "Rays/s": 9e9},
    {"name": "build/1048576/1/ours/iterations:3/manual_time", "family_index": 5, "run_type": "iteration",
     "seconds": 0.5, "bytes/sphere": 29.7},
    {"name": "build/1048576/1/ours/iterations:3/manual_time", "family_index": 5, "run_type": "iteration",
     "seconds": 0.4, "bytes/sphere": 29.7}
  ]})";

TEST(Results, KeepTheFastestRepetitionInTheOrderOfRegistration) {
    const Results results = read_results(json);
    EXPECT_EQ(results.cpu, "Some(R) CPU @ 2.50GHz");
    EXPECT_FALSE(results.whole) << "nothing says that all was measured";
    ASSERT_EQ(results.rows.size(), 5u);
    EXPECT_EQ(results.rows[0].variant, "avx2");
    EXPECT_EQ(results.rows[1].variant, "avx512");
    EXPECT_EQ(results.rows[1]["Rays/s"], 2e8);
    EXPECT_EQ(results.rows[4]["seconds"], 0.4);
    EXPECT_EQ(results.rows[4].what, "1");
    EXPECT_EQ(results.rows[2]["no such counter"], 0);
    EXPECT_FALSE(results.rows[2].counters.contains("real_time"));
    EXPECT_THAT(results.subjects("peer"), ElementsAre("random-8"));
    EXPECT_THAT(results.whats("peer", "random-8"), ElementsAre("primary"));
    EXPECT_EQ(results.find("peer", "random-8", "primary", "sse2"), nullptr);
}

TEST(Results, TheWidestInstructionSetMeetsTheBestOfEmbree) {
    const Results results = read_results(json);
    const auto matches = peer_matches(results);
    ASSERT_EQ(matches.size(), 1u);
    EXPECT_EQ(matches[0].ours->variant, "avx512");
    EXPECT_EQ(matches[0].embree->variant, "embree-16");
    EXPECT_THAT(blocks_of(results).at("peers"),
                HasSubstr("| random-8 | 8 | primary | 200 | 25 | embree-16 | 8.00 | 2.40 |"));
}

TEST(Results, AWrongResultMakesNoPage) {
    EXPECT_THROW(read_results(R"({"context": {}, "benchmarks": [{"name": "a/b/c/d", "family_index": 0,
        "error_occurred": true, "error_message": "3 of 4 records"}]})"),
                 std::runtime_error);
}

TEST(Results, WhatIsNoResultIsRefused) {
    for (const char* text : {"", "{", "[]", "{}", R"({"context": {}})", R"({"context": {}, "benchmarks": [{}]})",
                             R"({"context": {}, "benchmarks": [{"name": "short/name", "family_index": 0}]})"})
        EXPECT_THROW(read_results(text), std::runtime_error) << text;
}

TEST(Csv, HasALinePerRowAndNothingOfTheHost) {
    const std::string csv = csv_of(read_results(json));
    EXPECT_EQ(csv.substr(0, csv.find('\n')), "group,subject,what,variant,Rays/s,bytes/sphere,seconds,spheres");
    EXPECT_THAT(csv, HasSubstr("\npeer,random-8,primary,avx512,2e+08,,,8\n"));
    EXPECT_THAT(csv, HasSubstr("\nbuild,1048576,1,ours,,29.7,0.4,\n"));
    EXPECT_EQ(csv.find("secret"), std::string::npos);
}

TEST(FileName, IsThePlainPartOfAProcessorsName) {
    EXPECT_EQ(file_name_of("Intel(R) Xeon(R) Processor @ 2.50GHz"), "intel-xeon-2.50ghz");
    EXPECT_EQ(file_name_of("AMD Ryzen 9 7950X 16-Core Processor"), "amd-ryzen-9-7950x-16-core");
    EXPECT_EQ(file_name_of("../../etc"), "..-..-etc");
    EXPECT_EQ(file_name_of(""), "unknown");
}

}  // namespace
}  // namespace orrery::bench
