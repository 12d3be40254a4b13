#include "ClientWireFixture.hpp"
#include "RawMCS.hpp"

#include <chrono>
#include <cstddef>
#include <string>
#include <variant>
#include <vector>

// When positions are sent, and when they are dropped.

using namespace ACS; // NOLINT(google-build-using-namespace)
using namespace std::chrono_literals;
using Protocol::EAcsCommand;
using Testing::ClientWireFixture;
using Testing::MakeReport;
using Testing::RawMCS;

TEST_CASE("13.12 Positions are dropped while the socket is blocked, and not sent later")
{
    constexpr std::size_t POSITIONS = 50;
    constexpr std::size_t WINDOW = 12;
    ClientWireFixture rig;
    rig.raw.SetReceiveBuffer(16'384);
    rig.clientOptions.session.positionInterval = 1ms;
    rig.clientOptions.session.ackTimeout = 60s; // nothing is sent again
    rig.RegisterWithRaw();
    RawMCS& mcs = *rig.connections.at(0);

    // More than the socket buffers hold.
    mcs.GetPeer().StopReading();
    for (std::size_t i = 0; i < WINDOW; ++i)
    {
        REQUIRE(rig.client->TrySendDurable(MakeReport("big-" + std::to_string(i), std::string(1'000'000, 'x'))));
    }
    std::size_t due = 0;
    rig.acsEvents.onEvent = [&rig, &due](const Protocol::SessionEvent& event) {
        if (std::holds_alternative<Protocol::PositionDue>(event))
        {
            ++due;
            rig.client->SendPosition({{{"LR01", static_cast<double>(due), 0.0, 0.0, 100.0}}});
        }
    };
    REQUIRE(rig.WasReached([&due] { return due >= POSITIONS; }));
    rig.acsEvents.onEvent = nullptr;

    mcs.GetPeer().ReadAsync();
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::PlanReport) == WINDOW; }));
    REQUIRE(rig.client->TrySendDurable(MakeReport("end")));
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::PlanReport) == WINDOW + 1; }));
    CHECK(mcs.Count(EAcsCommand::RobotPositionUpdate) == 0);

    // Fresh ones go out again.
    rig.client->SendPosition({{{"LR01", 1.0, 0.0, 0.0, 100.0}}});
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::RobotPositionUpdate) == 1; }));
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().empty());
}

TEST_CASE("R14 A position is written together with the reports of the same moment")
{
    constexpr std::size_t ROUNDS = 50;
    constexpr std::size_t REPORTS = 8; // Larger than two positions.
    ClientWireFixture rig;
    rig.RegisterWithRaw();
    RawMCS& mcs = *rig.connections.at(0);
    for (std::size_t round = 1; round <= ROUNDS; ++round)
    {
        for (std::size_t i = 0; i < REPORTS; ++i)
        {
            REQUIRE(rig.client->TrySendDurable(MakeReport(std::to_string(round) + "-" + std::to_string(i))));
        }
        rig.client->SendPosition({{{"LR01", static_cast<double>(round), 0.0, 0.0, 100.0}}});
        REQUIRE(rig.WasReached([&] { return mcs.Count(EAcsCommand::PlanReport) == REPORTS * round; }));
        REQUIRE(rig.WasReached([&rig] { return rig.client->GetRoom() >= REPORTS; }));
    }
    REQUIRE(rig.client->TrySendDurable(MakeReport("end")));
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::PlanReport) == REPORTS * ROUNDS + 1; }));
    CHECK(mcs.Count(EAcsCommand::RobotPositionUpdate) == ROUNDS);
}

TEST_CASE("5.10 The parts of a split position update are written together, after the reports of the same moment")
{
    constexpr std::size_t ROUNDS = 20;
    constexpr std::size_t PARTS = 6;
    constexpr std::size_t REPORTS = 4;
    const Protocol::RobotPositionUpdate part{std::vector<Protocol::RobotPosition>(50, {"LR01", 1.0, 2.0, 90.0, 75.0})};
    ClientWireFixture rig;
    rig.RegisterWithRaw();
    RawMCS& mcs = *rig.connections.at(0);
    for (std::size_t round = 1; round <= ROUNDS; ++round)
    {
        for (std::size_t i = 0; i < REPORTS; ++i)
        {
            REQUIRE(rig.client->TrySendDurable(MakeReport(std::to_string(round) + "-" + std::to_string(i))));
        }
        for (std::size_t i = 0; i < PARTS; ++i)
        {
            rig.client->SendPosition(part);
        }
        REQUIRE(rig.WasReached([&] { return mcs.Count(EAcsCommand::PlanReport) == REPORTS * round; }));
        REQUIRE(rig.WasReached([&rig] { return rig.client->GetRoom() >= REPORTS; }));
    }
    REQUIRE(rig.client->TrySendDurable(MakeReport("end")));
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::PlanReport) == REPORTS * ROUNDS + 1; }));
    CHECK(mcs.Count(EAcsCommand::RobotPositionUpdate) == PARTS * ROUNDS);
}

TEST_CASE("13.12 Positions alone do not fill the socket buffer while the other side reads nothing")
{
    constexpr std::size_t POSITIONS = 1'000;
    ClientWireFixture rig;
    rig.raw.SetReceiveBuffer(4'096);
    rig.clientOptions.session.positionInterval = 1ms;
    rig.RegisterWithRaw();
    RawMCS& mcs = *rig.connections.at(0);
    mcs.GetPeer().StopReading();
    std::size_t due = 0;
    rig.acsEvents.onEvent = [&rig, &due](const Protocol::SessionEvent& event) {
        if (std::holds_alternative<Protocol::PositionDue>(event))
        {
            rig.client->SendPosition({{{"LR01", static_cast<double>(++due), 0.0, 0.0, 100.0}}});
        }
    };
    REQUIRE(rig.WasReached([&due] { return due >= POSITIONS; }));
    rig.acsEvents.onEvent = nullptr;
    mcs.GetPeer().ReadAsync();
    REQUIRE(rig.client->TrySendDurable(MakeReport("end")));
    REQUIRE(rig.WasReached([&mcs] { return mcs.Count(EAcsCommand::PlanReport) == 1; }));
    // What was sent before the receive buffer was full, and nothing after that.
    CHECK(mcs.Count(EAcsCommand::RobotPositionUpdate) < POSITIONS / 2);
    CHECK(rig.acsEvents.GetAll<Protocol::LinkLost>().empty());
}
