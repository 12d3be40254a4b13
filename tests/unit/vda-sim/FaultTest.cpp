#include "Catch.hpp"
#include "SeededRandom.hpp"
#include "vda-sim/FaultCommand.hpp"
#include "vda-sim/MessageGate.hpp"
#include "vda-sim/VehicleRandom.hpp"

#include <chrono>
#include <set>
#include <string>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VdaSim::EFaultDirection;
using VdaSim::EFaultKind;
using VdaSim::Fault;
using VdaSim::FaultBoard;
using VdaSim::FaultChange;
using VdaSim::FaultChanges;

constexpr Core::SteadyTime START{1000s};

Fault MakeFault(std::string_view text)
{
    Core::Result<Fault> fault = Apps::ParseFault(VdaSim::GetFaultGrammar(), text);
    REQUIRE(fault.has_value());
    return std::move(*fault);
}

/// "+stuck", "-stuck its time is over"
std::vector<std::string> TakeTexts(FaultChanges& changes)
{
    std::vector<std::string> texts;
    for (const FaultChange& change : changes)
    {
        const std::string name(VdaSim::GetFaultName(change.fault.kind));
        texts.push_back(change.bBegun ? "+" + name : "-" + name + " " + std::string(change.reason));
    }
    changes.clear();
    return texts;
}

using Texts = std::vector<std::string>;

VDA5050::MqttMessage MakeMessage(const std::string& topic, const std::string& payload)
{
    return {"uagv/v2/ACS/LR01/" + topic, payload, 0, false};
}

} // namespace

TEST_CASE("A fault is its name and its parameters, in any order, between any blanks")
{
    const Fault plain = MakeFault("stuck");
    CHECK(plain.kind == EFaultKind::Stuck);
    CHECK(plain.delay == 0s);
    CHECK_FALSE(plain.lasts.has_value());
    const Fault timed = MakeFault("  estop\tfor=5s   ack=REMOTE at=200ms ");
    CHECK(timed.kind == EFaultKind::EmergencyStop);
    CHECK(timed.emergencyStop == VDA5050::EEmergencyStop::Remote);
    CHECK(timed.delay == 200ms);
    CHECK(timed.lasts == Core::Duration(5s));
    CHECK(timed.text == "estop for=5s ack=REMOTE at=200ms");
    const Fault loss = MakeFault("loss percent=2.5 topic=state direction=out");
    CHECK(loss.percent == 2.5);
    CHECK(loss.topic == VDA5050::ETopic::State);
    CHECK(loss.direction == EFaultDirection::Out);
    CHECK(MakeFault("refuse level=FATAL").errorLevel == VDA5050::EErrorLevel::Fatal);
    CHECK(MakeFault("drop will=no").bWill == false);
    CHECK(MakeFault("mode mode=SERVICE node=N1").place == "N1");
    CHECK(MakeFault("action-fails type=pick when=start count=3").maxUses == 3U);
}

TEST_CASE("An invalid fault is refused with what is expected")
{
    for (const auto& [text, expected] : std::vector<std::pair<std::string, std::string>>{
             {"", "one of drop"},
             {"explode", "one of drop"},
             {"stuck now", "KEY=VALUE with a key of: at node for error level"},
             {"stuck percent=5", "KEY=VALUE"},
             {"stuck for=", "a duration"},
             {"stuck for=5", "a duration"},
             {"stuck for=1s for=2s", "each key once"},
             {"stuck node=", "a name"},
             {"delay topic=state", "time=DURATION"},
             {"stuck level=BAD", "one of WARNING, FATAL"},
             {"battery charge=101", "a number from 0 to 100"},
             {"battery charge=nan", "a number from 0 to 100"},
             {"battery for=5s", "KEY=VALUE"},
             {"refuse count=0", "a number from 1 to"},
             {"refuse count=-1", "a number from 1 to"},
             {"mode mode=manual", "one of MANUAL"},
             {"mode mode=AUTOMATIC", "one of MANUAL"},
             {"silence topic=order", "one of state, visualization, factsheet"},
             {"silence topic=connection", "one of state, visualization, factsheet"},
             {"loss topic=order direction=out", "in: a vehicle receives the topic order"},
             {"delay time=1s topic=state direction=in", "out: a vehicle publishes the topic state"},
             {"stuck level=FATAL", "error=ERRORTYPE"},
             {"action-fails level=FATAL", "error=ERRORTYPE"},
             {"delay", "time=DURATION"}})
    {
        CAPTURE(text);
        const Core::Result<Fault> fault = Apps::ParseFault(VdaSim::GetFaultGrammar(), text);
        REQUIRE_FALSE(fault.has_value());
        CHECK_THAT(fault.error().expected, Catch::Contains(expected));
    }
}

TEST_CASE("A command is for the vehicles that it names, and begins, ends or triggers")
{
    const auto begin = Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "LR* stuck for=5s");
    REQUIRE(begin.has_value());
    CHECK(begin->verb == VdaSim::EFaultVerb::Begin);
    CHECK(begin->fault.kind == EFaultKind::Stuck);
    CHECK(Apps::IsTarget(begin->targets, "LR07"));
    CHECK_FALSE(Apps::IsTarget(begin->targets, "CR07"));
    const auto end = Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "LR01 end stuck");
    REQUIRE(end.has_value());
    CHECK(end->verb == VdaSim::EFaultVerb::End);
    CHECK(end->kindToEnd == EFaultKind::Stuck);
    CHECK(Apps::IsTarget(end->targets, "LR01"));
    CHECK_FALSE(Apps::IsTarget(end->targets, "LR011"));
    CHECK_FALSE(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "* end")->kindToEnd.has_value());
    CHECK(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "* trigger")->verb == VdaSim::EFaultVerb::Trigger);
    for (const std::string text :
         {"", "LR01", "stuck for=5s", "LR01 end nothing", "LR01 end stuck now", "LR01 trigger 1"})
    {
        CAPTURE(text);
        CHECK_FALSE(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), text).has_value());
    }
}

TEST_CASE("A fault file has one fault per line, comments and empty lines; an error names its line")
{
    const auto commands =
        Apps::ParseFaultCommands(VdaSim::GetFaultGrammar(), "# all\r\n\n  A stuck # at once\r\nB drop for=1s");
    REQUIRE(commands.has_value());
    REQUIRE(commands->size() == 2);
    CHECK((*commands)[0].fault.text == "stuck");
    CHECK((*commands)[1].targets == "B");
    const auto wrong = Apps::ParseFaultCommands(VdaSim::GetFaultGrammar(), "A stuck\n\nA stuck for=long\n");
    REQUIRE_FALSE(wrong.has_value());
    CHECK(wrong.error().path == "line 3, stuck for");
}

TEST_CASE(
    "A fault file may begin with a byte order mark; invalid UTF-8, too long lines and too many faults are refused")
{
    const auto marked = Apps::ParseFaultCommands(
        VdaSim::GetFaultGrammar(),
        "\xEF\xBB\xBF"
        "LR01 stuck\n");
    REQUIRE(marked.has_value());
    CHECK(marked->front().targets == "LR01");
    CHECK_FALSE(Apps::ParseFaultCommands(VdaSim::GetFaultGrammar(), "LR01 stuck error=\xFF\xFE").has_value());
    CHECK_FALSE(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "\xC3 stuck").has_value());
    CHECK(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "LR01 stuck error=M\xC3\xBCller").has_value());
    CHECK(Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "LR01 stuck error=" + std::string(900, 'x')).has_value());
    CHECK_FALSE(
        Apps::ParseFaultCommand(VdaSim::GetFaultGrammar(), "LR01 stuck error=" + std::string(1000, 'x')).has_value());
    std::string many;
    for (int i = 0; i < 1000; ++i)
    {
        many += "A stuck\n";
    }
    CHECK(Apps::ParseFaultCommands(VdaSim::GetFaultGrammar(), many)->size() == 1000);
    const auto tooMany = Apps::ParseFaultCommands(VdaSim::GetFaultGrammar(), many + "# one more\nA stuck\n");
    REQUIRE_FALSE(tooMany.has_value());
    CHECK(tooMany.error().path == "line 1002");
}

TEST_CASE("The help has a line for every fault")
{
    const std::string help = Apps::MakeFaultHelp(VdaSim::GetFaultGrammar());
    for (std::size_t i = 0; i <= static_cast<std::size_t>(EFaultKind::Delay); ++i)
    {
        const auto kind = static_cast<EFaultKind>(i);
        CHECK_THAT(help, Catch::Contains("  " + std::string(VdaSim::GetFaultName(kind))));
        CHECK(Apps::ParseFaultKind(VdaSim::GetFaultGrammar(), VdaSim::GetFaultName(kind)) == kind);
    }
}

TEST_CASE("A fault begins after its delay and ends after its time")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("stuck at=10s for=5s"), START, changes);
    CHECK(changes.empty());
    CHECK(board.GetNextTimeOrNull() == START + 10s);
    board.OnTime(START + 9999ms, changes);
    CHECK_FALSE(board.IsActive(EFaultKind::Stuck));
    board.OnTime(START + 10s, changes);
    CHECK(TakeTexts(changes) == Texts{"+stuck"});
    CHECK(board.GetNextTimeOrNull() == START + 15s);
    board.OnTime(START + 14999ms, changes);
    CHECK(board.IsActive(EFaultKind::Stuck));
    board.OnTime(START + 15s, changes);
    CHECK(TakeTexts(changes) == Texts{"-stuck its time is over"});
    CHECK_FALSE(board.GetNextTimeOrNull().has_value());
}

TEST_CASE("A late timer does not prolong a fault, and a fault that is over by then is reported nevertheless")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("stuck at=1s for=5s"), START, changes);
    board.OnTime(START + 3s, changes);
    CHECK(board.GetNextTimeOrNull() == START + 6s);
    board.Add(MakeFault("lost at=1s for=1s"), START, changes);
    board.OnTime(START + 10s, changes);
    CHECK(TakeTexts(changes) == Texts{"+stuck", "+lost", "-stuck its time is over", "-lost its time is over"});
}

TEST_CASE("A fault with a node begins on the next arrival there, once per command")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("stuck node=N2 at=1s for=1s"), START, changes);
    board.OnPlace("N1", START + 5s, changes);
    CHECK_FALSE(board.GetNextTimeOrNull().has_value());
    board.OnPlace("N2", START + 6s, changes);
    CHECK(board.GetNextTimeOrNull() == START + 7s);
    board.OnTime(START + 7s, changes);
    board.OnTime(START + 8s, changes);
    CHECK(TakeTexts(changes) == Texts{"+stuck", "-stuck its time is over"});
    board.OnPlace("N2", START + 9s, changes);
    CHECK(changes.empty());
    CHECK(board.IsEmpty());
}

TEST_CASE("Ending ends the faults of the kind or all; those that have not begun are not reported")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("stuck"), START, changes);
    board.Add(MakeFault("stuck at=5s"), START, changes);
    board.Add(MakeFault("lost"), START, changes);
    changes.clear();
    CHECK(board.End(EFaultKind::Stuck, "ended by command", changes) == 2);
    CHECK(TakeTexts(changes) == Texts{"-stuck ended by command"});
    CHECK(board.IsActive(EFaultKind::Lost));
    CHECK(board.End(std::nullopt, "ended by command", changes) == 1);
    CHECK(board.IsEmpty());
    CHECK(board.End(std::nullopt, "ended by command", changes) == 0);
}

TEST_CASE("Of several faults of one kind the latest counts, and the previous one when it ends")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("mode mode=SERVICE"), START, changes);
    board.Add(MakeFault("mode mode=MANUAL for=1s"), START, changes);
    CHECK(board.FindOrNull(EFaultKind::Mode)->mode == VDA5050::EOperatingMode::Manual);
    board.OnTime(START + 1s, changes);
    CHECK(board.FindOrNull(EFaultKind::Mode)->mode == VDA5050::EOperatingMode::Service);
}

TEST_CASE("A counted fault ends when it is used up: after one use if neither count nor duration is given")
{
    FaultBoard board;
    FaultChanges changes;
    const auto countUses = [&](std::string_view text) {
        board.Add(MakeFault(text), START, changes);
        std::size_t uses = 0;
        for (; board.IsActive(EFaultKind::Refuse) && uses < 10; ++uses)
        {
            board.Use(*board.FindOrNull(EFaultKind::Refuse), changes);
        }
        board.OnTime(START + 1h, changes);
        return uses;
    };
    CHECK(countUses("refuse") == 1);
    CHECK(countUses("refuse count=3") == 3);
    CHECK(countUses("refuse for=1s") == 10);
    CHECK(countUses("refuse for=1s count=2") == 2);
}

TEST_CASE("A battery is set once")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("battery charge=3"), START, changes);
    CHECK(TakeTexts(changes) == Texts{"+battery"});
    CHECK(board.IsEmpty());
}

TEST_CASE("Without a fault every message goes through at once")
{
    FaultBoard board;
    SeededRandom random;
    VdaSim::MessageGate gate(EFaultDirection::Out);
    std::vector<VDA5050::MqttMessage> out;
    gate.Pass(MakeMessage("state", "1"), board, random, START, out);
    CHECK(out.size() == 1);
    CHECK_FALSE(gate.GetNextTimeOrNull().has_value());
}

TEST_CASE("A loss drops its share of the messages of its topic and direction, the same ones for the same seed")
{
    const auto getLost = [](std::string_view fault, EFaultDirection direction, std::string_view name) {
        FaultBoard board;
        FaultChanges changes;
        board.Add(MakeFault(fault), START, changes);
        VdaSim::VehicleRandom random(42, name);
        VdaSim::MessageGate gate(direction);
        std::vector<VDA5050::MqttMessage> out;
        for (int i = 0; i < 1000; ++i)
        {
            gate.Pass(MakeMessage(i % 2 == 0 ? "state" : "connection", std::to_string(i)), board, random, START, out);
        }
        std::string passed;
        for (const VDA5050::MqttMessage& message : out)
        {
            passed += message.payload + " ";
        }
        return std::pair{1000 - out.size(), passed};
    };
    CHECK(getLost("loss", EFaultDirection::In, "A").first == 1000);
    CHECK(getLost("loss percent=0", EFaultDirection::In, "A").first == 0);
    CHECK(getLost("loss topic=state", EFaultDirection::Out, "A").first == 500);
    CHECK(getLost("loss direction=in", EFaultDirection::Out, "A").first == 0);
    const auto some = getLost("loss percent=30", EFaultDirection::Out, "A");
    CHECK(some.first > 250);
    CHECK(some.first < 350);
    CHECK(getLost("loss percent=30", EFaultDirection::Out, "A") == some);
    CHECK(getLost("loss percent=30", EFaultDirection::Out, "B") != some);
}

TEST_CASE("A delay keeps the order of messages, those that are not delayed themselves included")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("delay time=500ms topic=state for=1s"), START, changes);
    SeededRandom random;
    VdaSim::MessageGate gate(EFaultDirection::Out);
    std::vector<VDA5050::MqttMessage> out;
    gate.Pass(MakeMessage("state", "1"), board, random, START, out);
    gate.Pass(MakeMessage("connection", "2"), board, random, START + 100ms, out);
    gate.Pass(MakeMessage("state", "3"), board, random, START + 200ms, out);
    CHECK(out.empty());
    CHECK(gate.GetNextTimeOrNull() == START + 500ms);
    gate.Release(START + 500ms, out);
    REQUIRE(out.size() == 2);
    CHECK(out[0].payload == "1");
    CHECK(out[1].payload == "2");
    board.OnTime(START + 1s, changes);
    gate.Pass(MakeMessage("state", "4"), board, random, START + 1s, out);
    gate.Release(START + 1s, out);
    REQUIRE(out.size() == 4);
    CHECK(out[2].payload == "3");
    CHECK(out[3].payload == "4");
}

TEST_CASE("A jitter draws each delay separately, within its bounds")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("delay time=100ms jitter=50ms"), START, changes);
    SeededRandom random;
    std::set<Core::SteadyTime> times;
    for (int i = 0; i < 100; ++i)
    {
        VdaSim::MessageGate gate(EFaultDirection::In);
        std::vector<VDA5050::MqttMessage> out;
        gate.Pass(MakeMessage("order", "x"), board, random, START, out);
        const Core::SteadyTime due = gate.GetNextTimeOrNull().value_or(START);
        CHECK(due >= START + 100ms);
        CHECK(due <= START + 150ms);
        times.insert(due);
    }
    CHECK(times.size() > 90);
}

TEST_CASE("A delay has a limit: further messages are lost, and there is room again later")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("delay time=1h"), START, changes);
    SeededRandom random;
    std::vector<VDA5050::MqttMessage> out;
    const auto fill = [&](VdaSim::MessageGate& gate, std::size_t count, std::size_t bytes) {
        for (std::size_t i = 0; i < count; ++i)
        {
            gate.Pass(MakeMessage("state", std::string(bytes, 'x')), board, random, START, out);
        }
        return gate.TakeOverflow();
    };
    VdaSim::MessageGate large(EFaultDirection::Out);
    CHECK(fill(large, 20, 1'000'000) == 4); // 16 MiB
    CHECK(fill(large, 1, 1) == 0);
    large.Release(START + 1h, out);
    CHECK(out.size() == 17);
    CHECK(fill(large, 16, 1'000'000) == 0);
    large.Clear();
    CHECK(fill(large, 16, 1'000'000) == 0);
    VdaSim::MessageGate small(EFaultDirection::Out);
    CHECK(fill(small, VdaSim::MessageGate::MAX_MESSAGES + 3, 1) == 3);
    CHECK(small.TakeOverflow() == 0);
}

TEST_CASE("A fault that ends as it begins leaves the others alone")
{
    FaultBoard board;
    FaultChanges changes;
    board.Add(MakeFault("lost at=1s"), START, changes);
    board.Add(MakeFault("stuck for=0ms"), START + 2s, changes);
    CHECK(TakeTexts(changes) == Texts{"+stuck", "-stuck its time is over"});
    CHECK(board.CountFaults() == 1);
    board.OnTime(START + 2s, changes);
    CHECK(TakeTexts(changes) == Texts{"+lost"});
}

TEST_CASE("A silent vehicle publishes only its connection, or is silent on one topic, and still receives")
{
    FaultBoard board;
    FaultChanges changes;
    SeededRandom random;
    VdaSim::MessageGate outgoing(EFaultDirection::Out);
    VdaSim::MessageGate incoming(EFaultDirection::In);
    std::vector<VDA5050::MqttMessage> out;
    board.Add(MakeFault("silence"), START, changes);
    outgoing.Pass(MakeMessage("state", "1"), board, random, START, out);
    outgoing.Pass(MakeMessage("connection", "2"), board, random, START, out);
    incoming.Pass(MakeMessage("order", "3"), board, random, START, out);
    REQUIRE(out.size() == 2);
    CHECK(out[0].payload == "2");
    CHECK(out[1].payload == "3");
    board.End(std::nullopt, "ended by command", changes);
    board.Add(MakeFault("silence topic=visualization"), START, changes);
    outgoing.Pass(MakeMessage("state", "4"), board, random, START, out);
    outgoing.Pass(MakeMessage("visualization", "5"), board, random, START, out);
    CHECK(out.size() == 3);
}

TEST_CASE("The delayed messages are lost with the connection")
{
    FaultBoard board;
    FaultChanges changes;
    SeededRandom random;
    board.Add(MakeFault("delay time=1s"), START, changes);
    VdaSim::MessageGate gate(EFaultDirection::In);
    std::vector<VDA5050::MqttMessage> out;
    gate.Pass(MakeMessage("order", "1"), board, random, START, out);
    gate.Clear();
    gate.Release(START + 1h, out);
    CHECK(out.empty());
    CHECK_FALSE(gate.GetNextTimeOrNull().has_value());
}

} // namespace ACS::Testing
