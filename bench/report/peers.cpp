#include "bench/report/peers.hpp"

namespace orrery::bench {

std::vector<PeerMatch> peer_matches(const Results& results) {
    std::vector<PeerMatch> matches;
    for (const std::string& scene : results.subjects("peer")) {
        for (const std::string& queue : results.whats("peer", scene)) {
            PeerMatch match{scene, queue, 0, nullptr, nullptr};
            for (const Row& row : results.rows) {
                if (row.group != "peer" || row.subject != scene || row.what != queue) continue;
                if (!row.variant.starts_with("embree"))
                    match.ours = &row;
                else if (match.embree == nullptr || row["Rays/s"] > (*match.embree)["Rays/s"])
                    match.embree = &row;
                match.spheres = row["spheres"];
            }
            matches.push_back(match);
        }
    }
    return matches;
}

}  // namespace orrery::bench
