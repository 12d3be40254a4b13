#include "controller/Fault.hpp"

#include "Catch.hpp"

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using OpenStreamSim::EFaultKind;
using OpenStreamSim::EFaultSide;
using OpenStreamSim::Fault;
using OpenStreamSim::FaultBoard;
using OpenStreamSim::FaultChange;
using OpenStreamSim::FaultChanges;
using OpenStreamSim::GetFaultGrammar;

constexpr Core::SteadyTime START{1000s};

Fault MakeFault(std::string_view text)
{
    Core::Result<Fault> fault = Apps::ParseFault(GetFaultGrammar(), text);
    REQUIRE(fault.has_value());
    return std::move(*fault);
}

/// "+" for a begin and "-" for an end each.
std::string TakeSigns(FaultChanges& changes)
{
    std::string signs;
    for (const FaultChange& change : changes)
    {
        signs += change.bBegun ? '+' : '-';
    }
    changes.clear();
    return signs;
}

} // namespace

TEST_CASE("9 A fault of a controller is its name and its parameters; some have defaults")
{
    CHECK(MakeFault("silence at=200ms for=5s").delay == 200ms);
    CHECK(MakeFault("silence at=200ms for=5s").lasts == Core::Duration(5s));
    CHECK_FALSE(MakeFault("silence").lasts.has_value());
    CHECK(MakeFault("hole").lasts == Core::Duration(100ms));
    CHECK(MakeFault("hole for=20ms every=1s").lasts == Core::Duration(20ms));
    CHECK(MakeFault("hole every=1s").every == Core::Duration(1s));
    CHECK(MakeFault("drop").bOnce);
    CHECK(MakeFault("slow").time == 500ms);
    CHECK(MakeFault("slow").side == EFaultSide::Both);
    CHECK(MakeFault("slow time=2s side=http").time == 2s);
    CHECK(MakeFault("slow time=2s side=http").side == EFaultSide::Http);
    CHECK(MakeFault("slow time=1m").time == 1min);
    CHECK(MakeFault("slow side=stream").side == EFaultSide::Stream);
    CHECK(MakeFault("refuse").status == 403);
    CHECK(MakeFault("refuse").code == -1554);
    CHECK(MakeFault("refuse count=3 status=500 code=7").maxUses == 3U);
    CHECK(MakeFault("refuse count=3 status=500 code=7").status == 500);
    CHECK(MakeFault("refuse count=3 status=500 code=7").code == 7);
    CHECK(MakeFault("mode silence=2s").silence == 2s);
    CHECK(MakeFault("estop program=11").place == "11");
    CHECK(MakeFault("program-fails when=start").bAtStart);
    CHECK_FALSE(MakeFault("program-fails when=end").bAtStart);
    CHECK(MakeFault("program-fails count=2").maxUses == 2U);
    CHECK(MakeFault("wrong-value count=3").maxUses == 3U);
    CHECK(MakeFault("  slow\ttime=1s ").text == "slow time=1s");
}

TEST_CASE("9 An invalid fault of a controller is refused with what is expected")
{
    for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
             {"", "one of silence, hole, drop"},
             {"stuck", "one of silence, hole, drop"},
             {"silence now", "KEY=VALUE with a key of: at program for every"},
             {"silence time=1s", "KEY=VALUE"},
             {"drop for=1s", "KEY=VALUE with a key of: at program every"},
             {"motor-off for=1s", "KEY=VALUE"},
             {"hole for=5", "a duration"},
             {"hole for=-5s", "a duration"},
             {"hole for=1s for=1s", "each key once"},
             {"hole every=100ms", "longer than for"},
             {"hole for=1ms every=9ms", "at least 10 ms"},
             {"drop every=9ms", "at least 10 ms"},
             {"drop every=0ms", "at least 10 ms"},
             {"silence every=5s", "longer than for=DURATION, which it needs"},
             {"refuse every=5s", "which it needs"},
             {"slow side=left", "one of stream, http, both"},
             {"slow time=soon", "a duration"},
             {"slow time=61s", "a duration of at most 1m"},
             {"refuse status=200", "a number from 400 to 599"},
             {"refuse status=600", "a number from 400 to 599"},
             {"refuse status=4e2", "a number from 400 to 599"},
             {"refuse code=2147483648", "a number from -2147483648"},
             {"refuse code=", "a number from"},
             {"refuse count=0", "a number from 1 to"},
             {"estop program=0", "a number from 1 to 9999"},
             {"estop program=10000", "a number from 1 to 9999"},
             {"program-fails when=later", "one of start, end"}})
    {
        CAPTURE(text);
        const Core::Result<Fault> fault = Apps::ParseFault(GetFaultGrammar(), text);
        REQUIRE_FALSE(fault.has_value());
        CHECK_THAT(fault.error().expected, Catch::Contains(expected));
    }
}

TEST_CASE("9 The help of a controller's faults has a line for every one, and nothing is triggered")
{
    const std::string help = Apps::MakeFaultHelp(GetFaultGrammar());
    for (std::size_t i = 0; i <= static_cast<std::size_t>(EFaultKind::ProgramFails); ++i)
    {
        const auto& row = Apps::GetFaultRow(GetFaultGrammar(), static_cast<EFaultKind>(i));
        CHECK_THAT(help, Catch::Contains("  " + std::string(row.name)));
        CHECK(Apps::ParseFaultKind(GetFaultGrammar(), row.name) == static_cast<EFaultKind>(i));
    }
    const auto trigger = Apps::ParseFaultCommand(GetFaultGrammar(), "1 trigger");
    REQUIRE_FALSE(trigger.has_value());
    const auto nothing = Apps::ParseFaultCommand(GetFaultGrammar(), "1");
    REQUIRE_FALSE(nothing.has_value());
    CHECK(nothing.error().expected == "CONTROLLER FAULT [KEY=VALUE]... or CONTROLLER end [FAULT]");
}

TEST_CASE("A repeated fault keeps its period, however late its timer is")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("hole at=1s for=100ms every=2s"), START, changes);
    CHECK(board.GetNextTimeOrNull() == START + 1s);
    board.OnTime(START + 1s, changes);
    CHECK(TakeSigns(changes) == "+");
    board.OnTime(START + 1150ms, changes);
    CHECK(TakeSigns(changes) == "-");
    CHECK_FALSE(board.IsActive(EFaultKind::Hole));
    CHECK(board.GetNextTimeOrNull() == START + 3s);
    board.OnTime(START + 3050ms, changes);
    CHECK(TakeSigns(changes) == "+");
    CHECK(board.GetNextTimeOrNull() == START + 3100ms);
    board.OnTime(START + 3100ms, changes);
    CHECK(board.GetNextTimeOrNull() == START + 5s);
    CHECK(board.End(EFaultKind::Hole, "ended by command", changes) == 1);
    CHECK(board.IsEmpty());
}

TEST_CASE("A fault without a duration is repeated if requested, and a used-up fault is complete the next time")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("drop every=1s"), START, changes);
    CHECK(TakeSigns(changes) == "+");
    CHECK_FALSE(board.IsActive(EFaultKind::Drop));
    CHECK(board.GetNextTimeOrNull() == START + 1s);
    board.OnTime(START + 1s, changes);
    CHECK(TakeSigns(changes) == "+");
    CHECK(board.GetNextTimeOrNull() == START + 2s);
    board.End(std::nullopt, "ended by command", changes);
    CHECK(changes.empty()); // it is to come, not active

    board.Add(MakeFault("refuse count=2 for=1s every=5s"), START, changes);
    for (int round = 0; round < 2; ++round)
    {
        for (int use = 0; use < 2; ++use)
        {
            REQUIRE(board.IsActive(EFaultKind::Refuse));
            board.Use(*board.FindOrNull(EFaultKind::Refuse), changes);
        }
        CHECK_FALSE(board.IsActive(EFaultKind::Refuse));
        CHECK(TakeSigns(changes) == "+-");
        CHECK(board.GetNextTimeOrNull() == START + (round + 1) * 5s);
        board.OnTime(START + (round + 1) * 5s, changes);
    }
}

} // namespace ACS::Testing
