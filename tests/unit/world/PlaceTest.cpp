#include "world/Place.hpp"

#include "Catch.hpp"
#include "world/EWorldError.hpp"

using namespace ACS; // NOLINT(google-build-using-namespace)
using Core::ESegmentKind;

TEST_CASE("A place has a canonical text, a kind and a station or a robot")
{
    const Sim::Place tray = Sim::ParsePlace("a01.cp2.tp1").value();
    CHECK(tray.text == "A01.CP02.TP01");
    CHECK(tray.kind == ESegmentKind::TrayPort);
    CHECK(tray.station == "A01.CP02");
    CHECK(tray.robotID.empty());
    CHECK(tray.IsPort());

    const Sim::Place memory = Sim::ParsePlace("A01.SET01.MP32").value();
    CHECK(memory.station == "A01.SET01");
    CHECK_FALSE(memory.IsPort());

    const Sim::Place port = Sim::ParsePlace("LR01.CP01").value();
    CHECK(port.robotID == "LR01");
    CHECK(port.station.empty());
}

TEST_CASE("A place inside a cassette on a robot is a valid place")
{
    const Sim::Place tray = Sim::ParsePlace("LR01.CP01.TP2").value();
    CHECK(tray.text == "LR01.CP01.TP02");
    CHECK(tray.robotID == "LR01");
    CHECK(tray.kind == ESegmentKind::TrayPort);
    CHECK(Sim::ParsePlace("LR01.CP01.TP02.MP03").value().text == "LR01.CP01.TP02.MP03");
}

TEST_CASE("GetCarrierPort returns the port whose carrier has the place")
{
    CHECK(Sim::ParsePlace("CR01.TP01.MP01").value().GetCarrierPort() == "CR01.TP01");
    CHECK(Sim::ParsePlace("A01.CP01.TP01.MP01").value().GetCarrierPort() == "A01.CP01.TP01");
    CHECK(Sim::ParsePlace("LR01.CP01.TP02").value().GetCarrierPort() == "LR01.CP01");
    CHECK(Sim::ParsePlace("A01.CP01.TP01").value().GetCarrierPort().empty());
    CHECK(Sim::ParsePlace("A01.SET01.MP01").value().GetCarrierPort().empty());
    CHECK(Sim::ParsePlace("CR01.TP01").value().GetCarrierPort().empty());
}

TEST_CASE("A text that is not a place of a floor is refused")
{
    for (const char* text :
         {"",
          "nonsense",
          "AMR.CP01",
          "AMR.CP01.TP01",
          "SET01.MP01",
          "LR01",
          "LR01.SET01.MP01",
          "LR01.ST01",
          "A01.CP00",
          "LR01.CP01.TP01.MP01.MP02",
          "A01..CP01"})
    {
        INFO(text);
        const auto place = Sim::ParsePlace(text);
        REQUIRE_FALSE(place.has_value());
        CHECK(place.error().code == Sim::EWorldError::InvalidPlace);
    }
}
