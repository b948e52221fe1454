#include <fmt/format.h>

#include <algorithm>

#include "bench/report/page.hpp"
#include "bench/report/peers.hpp"

namespace orrery::bench {

namespace {

const char* const vector_isas[] = {"sse2", "avx2", "avx512"};

std::string megarays(const Row* row) {
    if (row == nullptr) return "";
    const double rate = (*row)["Rays/s"] / 1e6;
    return rate < 100 ? fmt::format("{:.3g}", rate) : fmt::format("{:.0f}", rate);
}

std::string ratio(double a, double b) { return b > 0 && a > 0 ? fmt::format("{:.2f}", a / b) : ""; }

double rate(const Row* row) { return row != nullptr ? (*row)["Rays/s"] : 0; }

std::string setting(const Results& results) {
    return fmt::format("{}; one thread unless a row says otherwise; float. Embree: {}.\n", results.cpu, results.embree);
}

std::string machine(const Results& results) {
    std::string table = "| operation | | 10^9 per second |\n|---|---|---|\n";
    for (const Row& row : results.rows)
        if (row.group == "machine")
            table += fmt::format("| {} | {}, {} | {:.2f} |\n", row.subject, row.what, row.variant,
                                 row["Operations/s"] / 1e9);
    for (const Row& row : results.rows)
        if (row.group == "linear")
            table += fmt::format(
                "\n{} rays: {:.1f} tests of 16 rays per microsecond of {:.1f} that the ports allow, **{:.0f} %**.\n",
                row.what, row["tests/us"], row["bound/us"], 100 * row["tests/us"] / row["bound/us"]);
    return table;
}

std::string renders(const Results& results) {
    std::string table =
        "| scene | spheres | SSE2 | AVX2 | AVX-512 | 2 threads | SSE2 / AVX-512 | AVX2 / AVX-512 | 2 threads / 1 |\n"
        "|---|---|---|---|---|---|---|---|---|\n";
    for (const std::string& scene : results.subjects("render")) {
        const Row* isas[3];
        for (std::size_t i = 0; i < 3; ++i) isas[i] = results.find("render", scene, "1", vector_isas[i]);
        const Row* two = results.find("render", scene, "2", "avx512");
        double spheres = 0;
        for (const Row* row : isas)
            if (row != nullptr) spheres = (*row)["spheres"];
        table +=
            fmt::format("| {} | {:.0f} | {} | {} | **{}** | {} | {} | {} | {} |\n", scene, spheres, megarays(isas[0]),
                        megarays(isas[1]), megarays(isas[2]), megarays(two), ratio(rate(isas[0]), rate(isas[2])),
                        ratio(rate(isas[1]), rate(isas[2])), ratio(rate(two), rate(isas[2])));
    }
    return table;
}

std::string stages(const Results& results) {
    std::string page;
    for (const std::string& scene : results.subjects("stage")) {
        page += fmt::format("<details><summary>{}</summary>\n\n", scene);
        page +=
            "| stage @ bounce | bytes/ray | Mrays/s: SSE2 | AVX2 | AVX-512 | cycles/ray: SSE2 | AVX2 | AVX-512 |\n"
            "|---|---|---|---|---|---|---|---|\n";
        for (const std::string& stage : results.whats("stage", scene)) {
            std::string rates, cycles;
            double bytes = 0;
            for (const char* isa : vector_isas) {
                const Row* row = results.find("stage", scene, stage, isa);
                rates += fmt::format(" {} |", megarays(row));
                cycles += row != nullptr ? fmt::format(" {:.3g} |", (*row)["cycles/ray"]) : " |";
                if (row != nullptr) bytes = (*row)["bytes/ray"];
            }
            page += fmt::format("| {} | {:.0f} |{}{}\n", stage, bytes, rates, cycles);
        }
        page += "\n</details>\n";
    }
    return page;
}

std::string builds(const Results& results) {
    std::string table = "| | spheres | threads | seconds | bytes/sphere |\n|---|---|---|---|---|\n";
    for (const Row& row : results.rows)
        if (row.group == "build")
            table += fmt::format("| {} | {} | {} | {:.3f} | {:.1f} |\n", row.variant, row.subject, row.what,
                                 row["seconds"], row["bytes/sphere"]);
    return table;
}

std::string peers(const Results& results) {
    std::string table =
        "| scene | spheres | queue | ours | Embree's best | which | ours / Embree | AVX2 / Embree |\n"
        "|---|---|---|---|---|---|---|---|\n";
    for (const PeerMatch& match : peer_matches(results)) {
        const Row* avx2 = results.find("peer", match.scene, match.queue, "avx2");
        table += fmt::format("| {} | {:.0f} | {} | {} | {} | {} | {} | {} |\n", match.scene, match.spheres, match.queue,
                             megarays(match.ours), megarays(match.embree),
                             match.embree != nullptr ? match.embree->variant : "",
                             ratio(rate(match.ours), rate(match.embree)), ratio(rate(avx2), rate(match.embree)));
    }
    return table;
}

}  // namespace

std::map<std::string, std::string> blocks_of(const Results& results) {
    return {{"setting", setting(results)}, {"machine", machine(results)}, {"renders", renders(results)},
            {"peers", peers(results)},     {"stages", stages(results)},   {"builds", builds(results)}};
}

}  // namespace orrery::bench
