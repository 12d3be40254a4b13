#include "FuzzCheck.hpp"
#include <acs/plan/LifReader.hpp>
#include <acs/plan/UnusedLifMember.hpp>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    using namespace ACS; // NOLINT(google-build-using-namespace)
    const Core::Result<Planning::SiteMap> site = Planning::DecodeLIF(Fuzz::AsText(data, size));
    const bool bUnused = !Planning::FindUnusedMembers(Fuzz::AsText(data, size)).empty();
    if (site)
    {
        Fuzz::Require(bUnused, "the creator of a file is not used");
        for (const Planning::SiteEdge& edge : site->GetEdges())
        {
            Fuzz::Require(site->FindNodeOrNull(edge.startNodeID) != nullptr, "an edge starts at a known node");
            Fuzz::Require(site->FindNodeOrNull(edge.endNodeID) != nullptr, "an edge ends at a known node");
        }
    }
    return 0;
}
