#include "vda-sim/VdaSimOptions.hpp"

#include "Catch.hpp"
#include "VehicleDriver.hpp"

namespace ACS::Testing
{

using VdaSim::EVehicleType;
using VdaSim::VehicleSpec;

TEST_CASE("A vehicle is its name, and optionally its type and its node, in any order")
{
    CHECK(VdaSim::ParseVehicleSpec("LR01") == VehicleSpec{"LR01", EVehicleType::Logistics, std::nullopt});
    CHECK(VdaSim::ParseVehicleSpec("CR01,type=CR") == VehicleSpec{"CR01", EVehicleType::Control, std::nullopt});
    CHECK(VdaSim::ParseVehicleSpec("X,node=N1,type=LR") == VehicleSpec{"X", EVehicleType::Logistics, "N1"});
}

TEST_CASE("What is no vehicle is told with what would be one")
{
    for (const std::string text :
         {"",
          ",type=LR",
          "A/B",
          "A+",
          "A,type=",
          "A,type=lr",
          "A,node=",
          "A,speed=3",
          "A,type=LR,type=CR",
          "A,node=N1,node=N2",
          "A,,"})
    {
        CAPTURE(text);
        const Core::Result<VehicleSpec> spec = VdaSim::ParseVehicleSpec(text);
        REQUIRE_FALSE(spec.has_value());
        CHECK_FALSE(spec.error().expected.empty());
    }
}

TEST_CASE("A vehicle begins at its own node, else at the charger of its number, else at the first node")
{
    const Planning::SiteMap site = MakeTestSite();
    const VehicleSpec plain{"A", EVehicleType::Logistics, std::nullopt};
    CHECK(VdaSim::GetStartNode(plain, 0, site) == "DOCK");
    CHECK(VdaSim::GetStartNode(plain, 1, site) == "N0");
    CHECK(VdaSim::GetStartNode({"A", EVehicleType::Logistics, "N2"}, 0, site) == "N2");
    const auto unknown = VdaSim::GetStartNode({"A", EVehicleType::Logistics, "N9"}, 0, site);
    REQUIRE_FALSE(unknown.has_value());
    CHECK(unknown.error() == "vehicle A: the site has no node N9");
}

TEST_CASE("A site that is no file is named")
{
    const auto site = VdaSim::LoadSite("/nonexistent/site.lif.json");
    REQUIRE_FALSE(site.has_value());
    CHECK_THAT(site.error(), Catch::Contains("/nonexistent/site.lif.json"));
    CHECK_FALSE(VdaSim::LoadSite("/").has_value());
}

} // namespace ACS::Testing
