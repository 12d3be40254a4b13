#include "robot/PortLedger.hpp"

#include "Catch.hpp"

#include <array>

using namespace ACS::Planning; // NOLINT(google-build-using-namespace): a test of that namespace
using ACS::Core::Location;

namespace
{

const std::array<Location, 2>& GetTestPorts()
{
    static const std::array<Location, 2> PORTS{
        Location::Parse("CR01.TP01").value(),
        Location::Parse("CR01.TP02").value()};
    return PORTS;
}

PortLedger MakeLedger(const CarrierIDs& carriers = {std::nullopt, std::nullopt})
{
    PortLedger ledger(GetTestPorts());
    ledger.Restore({"CR01", carriers, {"CR01.TP01", "CR01.TP02"}});
    return ledger;
}

std::vector<PortLoad> MakeLoads(const CarrierIDs& carriers)
{
    std::vector<PortLoad> loads;
    for (std::size_t i = 0; i < carriers.size(); ++i)
    {
        loads.push_back({GetTestPorts().at(i).GetText(), carriers[i].has_value(), carriers[i].value_or("")});
    }
    return loads;
}

} // namespace

TEST_CASE("PortLedger: a job moves its carrier, and an unknown one where the plan gives no id")
{
    PortLedger ledger = MakeLedger();
    CHECK(ledger.Move(std::array{PortUse{0, true}}, "T1").empty());
    CHECK(ledger.Move(std::array{PortUse{0, false}, PortUse{1, true}}, std::nullopt).empty());
    CHECK(ledger.GetCarriers() == CarrierIDs{std::nullopt, "T1"});
    CHECK(ledger.FindCarrierOrNull("T1") == 1U);
    CHECK(ledger.Move(std::array{PortUse{0, true}}, std::nullopt).empty());
    CHECK(ledger.GetCarriers() == CarrierIDs{"UNKNOWN", "T1"});
}

TEST_CASE("PortLedger: a job that contradicts the record still changes it")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    CHECK(
        ledger.Move(std::array{PortUse{0, true}}, "T2")
        == "CR01.TP01 was loaded, but the record has T1 there. Check the port and correct the record.");
    CHECK(
        ledger.Move(std::array{PortUse{1, false}}, "T3")
        == "CR01.TP02 was unloaded, but the record has no carrier there. Check the port and correct the record.");
    CHECK(
        ledger.Move(std::array{PortUse{0, false}}, "T3")
        == "T3 was unloaded from CR01.TP01, but the record has T2 there. Check the port and correct the record.");
    CHECK(ledger.GetCarriers() == CarrierIDs{std::nullopt, std::nullopt});
}

TEST_CASE("PortLedger: a report replaces the record and the port is disputed until the expected carrier is back")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    CHECK_FALSE(ledger.Compare(MakeLoads({"T1", std::nullopt}), {}).bDisputed);

    const PortLedger::Comparison comparison = ledger.Compare(MakeLoads({"T2", std::nullopt}), {});
    CHECK(comparison.bRecordChanged);
    CHECK(comparison.bDisputed);
    CHECK(ledger.GetCarriers() == CarrierIDs{"T2", std::nullopt});
    CHECK(ledger.DescribeDisputes() == "CR01.TP01: expected T1, reported T2");

    CHECK(ledger.Compare(MakeLoads({"T1", std::nullopt}), {}).bRecordChanged);
    CHECK_FALSE(ledger.IsDisputed());
    CHECK(ledger.GetCarriers() == CarrierIDs{"T1", std::nullopt});
}

TEST_CASE("PortLedger: a report without an id keeps the id on record")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    CHECK_FALSE(ledger.Compare(std::array{PortLoad{"CR01.TP01", true, ""}}, {}).bRecordChanged);
    CHECK(ledger.Compare(std::array{PortLoad{"CR01.TP02", true, ""}}, {}).bRecordChanged);
    CHECK(ledger.GetCarriers() == CarrierIDs{"T1", "UNKNOWN"});
}

TEST_CASE("PortLedger: a carrier that is reported at two ports changes no id")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    CHECK(ledger.Compare(MakeLoads({"T1", "T1"}), {}).bDisputed);
    CHECK(ledger.GetCarriers() == CarrierIDs{"T1", "UNKNOWN"});
    CHECK(
        ledger.DescribeDisputes()
        == "CR01.TP01: expected T1, reported T1, also at CR01.TP02; CR01.TP02: expected no carrier, reported T1, also at "
           "CR01.TP01");
}

TEST_CASE("PortLedger: a report about the port of an open job is no evidence")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    const PortLedger::Comparison comparison =
        ledger.Compare(MakeLoads({std::nullopt, "T1"}), std::array{PortUse{0, false}, PortUse{1, true}});
    CHECK_FALSE(comparison.bRecordChanged);
    CHECK_FALSE(comparison.bDisputed);
}

TEST_CASE("PortLedger: a job or an operator ends a dispute")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    static_cast<void>(ledger.Compare(MakeLoads({std::nullopt, std::nullopt}), {}));
    REQUIRE(ledger.IsDisputed());
    SECTION("a job that uses the port")
    {
        static_cast<void>(ledger.Move(std::array{PortUse{0, true}}, "T2"));
    }
    SECTION("a correction of the record")
    {
        ledger.Correct({"T2", std::nullopt});
        CHECK(ledger.GetCarriers() == CarrierIDs{"T2", std::nullopt});
    }
    SECTION("a cleared alarm")
    {
        ledger.ForgetDisputes();
    }
    CHECK_FALSE(ledger.IsDisputed());
}

TEST_CASE("PortLedger: disputes are reported once in an interval")
{
    PortLedger ledger = MakeLedger();
    CHECK(ledger.TryBeginReportInterval());
    CHECK_FALSE(ledger.TryBeginReportInterval());
    ledger.EndReportInterval();
    CHECK(ledger.TryBeginReportInterval());
}

TEST_CASE("PortLedger: a memory place needs its tray on record, or a job that loads it before")
{
    PortLedger ledger = MakeLedger({"T1", std::nullopt});
    const Location first = Location::Parse("CR01.TP01.MP01").value();
    const Location second = Location::Parse("AMR.TP02.MP01").value();
    CHECK_FALSE(ledger.FindMissingTrayOrNull(first, {}).has_value());
    CHECK(ledger.FindMissingTrayOrNull(second, {}) == 1U);
    CHECK_FALSE(ledger.FindMissingTrayOrNull(second, {{1, true}}).has_value());
    CHECK(ledger.FindMissingTrayOrNull(first, {{0, false}}) == 0U);
    CHECK_FALSE(ledger.FindMissingTrayOrNull(Location::Parse("SET02.MP15").value(), {}).has_value());
}

TEST_CASE(
    "PortLedger: stored carriers return to their ports by name, whatever the order and number of the ports is now")
{
    struct Case
    {
        CarriersChanged stored;
        CarrierIDs expected;
        std::string stranded;
    };
    const std::string unknown(UNKNOWN_CARRIER);
    const std::vector<Case> cases{
        {{"CR01", {"T2", "T1"}, {"CR01.TP02", "CR01.TP01"}}, {"T1", "T2"}, ""},
        {{"CR01", {"T1"}, {"CR01.TP01"}}, {"T1", std::nullopt}, ""}, // a port was added
        {{"CR01", {"T0", std::nullopt, "T1"}, {"CR01.TP03", "CR01.TP02", "CR01.TP01"}},
         {"T1", std::nullopt},
         "T0 (CR01.TP03)"},
        {{"CR01", {"T1", "T2"}, {"CR01.TP01", "CR01.TP04"}}, {"T1", unknown}, "T2 (CR01.TP04)"}, // perhaps another name
        {{"CR01", {std::nullopt, "T2"}, {"CR01.TP04", "CR01.TP02"}}, {std::nullopt, "T2"}, ""},
        {{"CR01", {"T1", std::nullopt}, {}}, {"T1", std::nullopt}, ""}, // of a version without names
        {{"CR01", {"T1", "T2", std::nullopt}, {}}, {unknown, unknown}, "T1 (port 1), T2 (port 2)"},
        {{"CR01", {std::nullopt}, {}}, {std::nullopt, std::nullopt}, ""}};
    for (const Case& restored : cases)
    {
        PortLedger ledger(GetTestPorts());
        ledger.Restore(restored.stored);
        CHECK(ledger.DescribeStranded() == restored.stranded);
        CHECK(ledger.GetCarriers() == restored.expected);
    }
}

TEST_CASE(
    "PortLedger: a carrier of a port that no longer exists is back with the port, unless the record was corrected before")
{
    PortLedger ledger({GetTestPorts().data(), 1});
    ledger.Restore({"CR01", {"T1", "T2"}, {"CR01.TP01", "CR01.TP02"}});
    CHECK(ledger.GetCarriers() == CarrierIDs{"T1"});
    PortLedger before(GetTestPorts());
    before.Restore(ledger.MakeRecord("CR01"));
    CHECK(before.GetCarriers() == CarrierIDs{"T1", "T2"});
    CHECK(before.DescribeStranded().empty());

    ledger.Correct({"T1"});
    PortLedger corrected(GetTestPorts());
    corrected.Restore(ledger.MakeRecord("CR01"));
    CHECK(corrected.GetCarriers() == CarrierIDs{"T1", std::nullopt});
}

TEST_CASE("PortLedger: what it stores it restores")
{
    const CarriersChanged record = MakeLedger({"T1", std::nullopt}).MakeRecord("CR01");
    CHECK(record == CarriersChanged{"CR01", {"T1", std::nullopt}, {"CR01.TP01", "CR01.TP02"}});
}
