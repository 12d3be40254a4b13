#include "SessionTimers.hpp"
#include "TemporaryFolder.hpp"
#include "VdaSimFixture.hpp"

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <functional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Testing
{
namespace
{

using namespace std::chrono_literals;
using VDA5050::EActionStatus;
using VDA5050::StateMessage;

const std::string CONTROL_TOPIC = "vda-sim/control";
const std::string WITNESS = "W"; ///< A vehicle without a fault: what reaches the master from it shows that time passes.

/// How a fault is commanded.
enum class EWay : std::uint8_t
{
    CommandLine,
    File,
    ControlTopic,
};

class WaysTest : public VdaSimFixture
{
protected:
    WaysTest()
    {
        _master->link.Subscribe({{CONTROL_TOPIC + "/result", 1}});
    }

    [[nodiscard]] static std::string GetTopic(const std::string& vehicle, std::string_view topic)
    {
        return "uagv/v2/ACS/" + vehicle + "/" + std::string(topic);
    }

    [[nodiscard]] std::size_t Count(const std::string& vehicle, std::string_view topic) const
    {
        return _master->listener.CountTopic(GetTopic(vehicle, topic));
    }

    [[nodiscard]] std::size_t CountConnections(const std::string& vehicle, std::string_view word) const
    {
        return static_cast<std::size_t>(std::ranges::count_if(
            _master->listener.messages,
            [topic = GetTopic(vehicle, "connection"), quoted = "\"" + std::string(word) + "\""](const auto& message) {
                return message.topic == topic && message.payload.find(quoted) != std::string::npos;
            }));
    }

    [[nodiscard]] StateMessage GetState(const std::string& vehicle)
    {
        const VDA5050::MqttMessage* const last = _master->listener.FindLastOrNull(GetTopic(vehicle, "state"));
        return last == nullptr ? StateMessage{} : _codec.Decode<StateMessage>(last->payload).value();
    }

    /// To the first node; the pick there shows that actions run.
    void SendOrder(const std::string& vehicle)
    {
        VDA5050::OrderMessage order = MakeOrder(2);
        order.header.serialNumber = vehicle;
        VDA5050::Action pick;
        pick.actionType = "pick";
        pick.actionID = "pick-here";
        pick.blockingType = VDA5050::EBlockingType::Hard;
        pick.actionParameters = {
            {"stationType", Core::JsonText::FromString("rack")},
            {"loadType", Core::JsonText::FromString("cassette")}};
        order.nodes[1].actions.push_back(std::move(pick));
        const std::string payload = _codec.Encode(order, VDA5050::EVda5050Version::Version200);
        REQUIRE(_master->link.Publish({GetTopic(vehicle, "order"), payload, 2, false}).has_value());
    }

    void WaitUntil(const std::function<bool()>& isSo)
    {
        REQUIRE(TryRunUntil(_context, isSo, PATIENCE));
    }

    /// Runs until the witness has published this number of visualizations.
    void LetPass(std::size_t visualizations)
    {
        const std::size_t before = Count(WITNESS, "visualization");
        WaitUntil([&]() { return Count(WITNESS, "visualization") >= before + visualizations; });
    }

    [[nodiscard]] static bool HasError(const StateMessage& state, std::string_view type)
    {
        return std::ranges::find(state.errors, type, &VDA5050::VehicleError::errorType) != state.errors.end();
    }
};

/// What the master sees of a fault; the vehicle was sent an order if it was to be.
struct FaultRow
{
    std::string vehicle;
    std::string fault;
    bool bOrdered = false;
    std::function<bool(const StateMessage&)> isShown;
};

const std::vector<FaultRow>& ListStateFaults()
{
    static const std::vector<FaultRow> ROWS{
        {"STUCK",
         "stuck error=jammed",
         true,
         [](const StateMessage& state) {
             return state.orderID == "order-1" && !state.bDriving && state.errors.at(0).errorType == "jammed";
         }},
        {"BLOCKED",
         "blocked",
         false,
         [](const StateMessage& state) {
             return state.safetyState.bFieldViolation && state.errors.at(0).errorType == "blockedByObstacle";
         }},
        {"LOST",
         "lost",
         true,
         [](const StateMessage& state) {
             const auto& errors = state.errors;
             return !state.agvPosition->bPositionInitialized && state.orderID.empty() && errors.size() == 2
                 && errors[0].errorType == "localizationError" && errors[1].errorType == "noRouteError";
         }},
        {"FAILS",
         "action-fails",
         true,
         [](const StateMessage& state) {
             return !state.actionStates.empty() && state.actionStates[0].actionStatus == EActionStatus::Failed
                 && state.lastNodeID == "N045";
         }},
        {"ESTOP",
         "estop",
         true,
         [](const StateMessage& state) {
             return state.safetyState.emergencyStop == VDA5050::EEmergencyStop::Manual && !state.bDriving
                 && state.orderID == "order-1" && state.errors.at(0).errorType == "emergencyStop";
         }},
        {"MODE",
         "mode",
         true,
         [](const StateMessage& state) {
             return state.operatingMode == VDA5050::EOperatingMode::Manual && state.orderID.empty()
                 && !state.errors.empty() && state.errors[0].errorType == VDA5050::ErrorTypes::ORDER_ERROR;
         }},
        {"BATTERY",
         "battery",
         false,
         [](const StateMessage& state) {
             return state.batteryState.batteryCharge == 10.0 && state.errors.at(0).errorType == "batteryLow";
         }},
        {"REFUSE", "refuse error=orderUpdateError", true, [](const StateMessage& state) {
             return state.orderID.empty() && !state.errors.empty()
                 && state.errors[0].errorType == VDA5050::ErrorTypes::ORDER_UPDATE_ERROR;
         }}};
    return ROWS;
}

/// Those that show by what comes and does not come.
const std::vector<FaultRow>& ListLinkFaults()
{
    static const std::vector<FaultRow> ROWS{
        {"DROP", "drop", false, {}},
        {"QUIET", "drop will=no for=300ms", false, {}},
        {"SILENT", "silence", false, {}},
        {"HALF", "silence topic=visualization", false, {}},
        {"DEAF", "loss percent=100 direction=in topic=order", true, {}},
        {"MUTE", "loss percent=100 direction=out topic=state", true, {}},
        {"LATE", "delay time=600ms direction=out topic=state", true, {}}};
    return ROWS;
}

std::vector<FaultRow> ListFaults()
{
    std::vector<FaultRow> rows = ListStateFaults();
    std::ranges::copy(ListLinkFaults(), std::back_inserter(rows));
    return rows;
}

std::vector<std::string> ListCommands()
{
    std::vector<std::string> lines;
    for (const FaultRow& row : ListFaults())
    {
        lines.push_back(row.vehicle + " " + row.fault);
    }
    return lines;
}

} // namespace

TEST_CASE_METHOD(WaysTest, "vda-sim: the master sees every fault, set by command line, by file or at run time")
{
    const EWay way = GENERATE(EWay::CommandLine, EWay::File, EWay::ControlTopic);
    CAPTURE(static_cast<int>(way));
    const TemporaryFolder folder;
    const std::string file = (folder.GetPath() / "faults.txt").string();
    std::vector<std::string> command = MakeCommand(_broker.GetURL(), ACS_SITE_FILE, WITNESS + ",node=D-CHG01");
    for (const FaultRow& row : ListFaults())
    {
        command.insert(command.end(), {"--vehicle", row.vehicle + ",node=D-CHG01"});
    }
    std::string lines;
    for (const std::string& line : ListCommands())
    {
        lines += line + "\n";
        if (way == EWay::CommandLine)
        {
            command.insert(command.end(), {"--fault", line});
        }
    }
    if (way == EWay::File)
    {
        std::ofstream(file) << lines;
        command.insert(command.end(), {"--fault-file", file});
    }
    ChildProcess program(command);
    REQUIRE(program.TryWaitForText("ready: broker=", PATIENCE));
    if (way == EWay::ControlTopic)
    {
        for (const FaultRow& row : ListFaults())
        {
            WaitUntil([&]() { return Count(row.vehicle, "state") > 0; });
        }
        REQUIRE(_master->link.Publish({CONTROL_TOPIC, lines, 1, false}).has_value());
        WaitUntil([&]() { return _master->listener.CountTopic(CONTROL_TOPIC + "/result") == 1; });
        CHECK_THAT(
            _master->listener.FindLastOrNull(CONTROL_TOPIC + "/result")->payload,
            !Catch::Contains("error:") && Catch::StartsWith("ok: vehicles=1 stuck"));
    }
    LetPass(2); // what was on its way before the faults
    const std::size_t silentBefore = _master->listener.messages.size();
    const std::size_t mutedStates = Count("MUTE", "state");
    const std::size_t lateStates = Count("LATE", "state");
    for (const FaultRow& row : ListFaults())
    {
        if (row.bOrdered)
        {
            SendOrder(row.vehicle);
        }
    }
    SendOrder(WITNESS);

    WaitUntil([&]() { return Count("LATE", "state") > lateStates; });
    CHECK(ReadClock().wall - GetState("LATE").header.timestamp >= 600ms);
    for (const FaultRow& row : ListStateFaults())
    {
        CAPTURE(row.vehicle);
        WaitUntil([&]() { return Count(row.vehicle, "state") > 0 && row.isShown(GetState(row.vehicle)); });
    }
    WaitUntil([&]() { return CountConnections("DROP", "CONNECTIONBROKEN") == 1; });
    WaitUntil([&]() { return CountConnections("QUIET", "ONLINE") == 2; });
    CHECK(CountConnections("QUIET", "CONNECTIONBROKEN") == 0);
    CHECK(CountConnections("QUIET", "OFFLINE") == 0);
    WaitUntil([&]() { return GetState(WITNESS).lastNodeID == "N045"; });
    LetPass(5);
    CHECK(GetState("DEAF").orderID.empty());
    CHECK(Count("MUTE", "state") == mutedStates);
    // It drives although it reports nothing.
    const VDA5050::MqttMessage* const seen = _master->listener.FindLastOrNull(GetTopic("MUTE", "visualization"));
    REQUIRE(seen != nullptr);
    const auto visualization = _codec.Decode<VDA5050::VisualizationMessage>(seen->payload);
    REQUIRE(visualization.has_value());
    CHECK(visualization->agvPosition->x > 1.9);
    const auto isOf = [&](const std::string& vehicle, std::string_view topic) {
        return std::count_if(
            _master->listener.messages.begin() + static_cast<std::ptrdiff_t>(silentBefore),
            _master->listener.messages.end(),
            [name = GetTopic(vehicle, topic)](const auto& message) { return message.topic.starts_with(name); });
    };
    CHECK(isOf("SILENT", "") == 0);
    CHECK(isOf("HALF", "visualization") == 0);
    CHECK(CountConnections("SILENT", "ONLINE") == 1);
    CHECK(CountConnections("SILENT", "CONNECTIONBROKEN") == 0);

    program.Signal(SIGTERM);
    CHECK(program.WaitForExitOrNull(PATIENCE) == 0);
}

} // namespace ACS::Testing
