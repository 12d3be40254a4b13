#include "MasterOwner.hpp"
#include <acs/vda5050/ActionMachine.hpp>

#include <array>
#include <chrono>
#include <string>
#include <string_view>
#include <utility>

/// Master control between a vehicle that mostly follows its orders and sometimes sends anything, a broker that loses messages, a
/// caller that sends orders at any time, and a clock: the rules are in MasterOwner.

namespace
{

using namespace ACS;          // NOLINT(google-build-using-namespace)
using namespace ACS::VDA5050; // NOLINT(google-build-using-namespace)

VehicleError MakeError(const StateMessage& state, Fuzz::Choices& choices)
{
    static constexpr std::array TYPES{
        ErrorTypes::VALIDATION_ERROR,
        ErrorTypes::ORDER_UPDATE_ERROR,
        ErrorTypes::ACTION_ERROR,
        std::string_view("madeUp")};
    VehicleError error;
    error.errorType = TYPES.at(choices.Take(TYPES.size()));
    switch (choices.Take(6))
    {
        case 0:
            error.errorReferences = {{"orderId", state.orderID}};
            break;
        case 1:
            error.errorReferences = {
                {"orderId", "o" + std::to_string(choices.Take(4))},
                {"orderUpdateId", std::to_string(choices.Take(4))}};
            break;
        case 2:
            error.errorReferences = {{"topic", "order"}, {"headerId", std::to_string(choices.Take(8))}};
            break;
        case 3:
            error.errorReferences = {{"actionId", "i" + std::to_string(choices.Take(8))}};
            break;
        case 4:
            error.errorReferences = {{"topic", "order"}};
            break;
        default:
            break;
    }
    return error;
}

void AddMany(StateMessage& state, Fuzz::Choices& choices)
{
    const std::uint32_t kind = choices.Take(4);
    for (std::uint32_t count = 0; count < 200; ++count)
    {
        switch (kind)
        {
            case 0:
                state.errors.push_back(VehicleError{"e" + std::to_string(count), {}, {}, {}, EErrorLevel::Fatal});
                break;
            case 1:
                state.actionStates.push_back(
                    ActionState{"x" + std::to_string(count), "pick", {}, EActionStatus::Running, {}});
                break;
            case 2:
                state.nodeStates.push_back(NodeState{"x", 2 * count, {}, true, {}});
                break;
            default:
                state.edgeStates.push_back(EdgeState{"x", 2 * count + 1, {}, true, {}});
                break;
        }
    }
}

/// What a vehicle that follows its orders does not send.
void Distort(StateMessage& state, Fuzz::Choices& choices)
{
    switch (choices.Take(16))
    {
        case 0:
            state.orderID = choices.Take(4) == 1 ? std::string() : "o" + std::to_string(choices.Take(6));
            break;
        case 1:
            state.orderUpdateID = choices.Take(8) == 1 ? ~0U - choices.Take(2) : choices.Take(6);
            break;
        case 2:
            state.lastNodeSequenceID = choices.Take(16);
            state.lastNodeID = "n" + std::to_string(state.lastNodeSequenceID / 2);
            break;
        case 3:
            state.nodeStates.clear();
            state.edgeStates.clear();
            break;
        case 4:
            for (NodeState& node : state.nodeStates)
            {
                node.bReleased = !node.bReleased;
            }
            break;
        case 5:
            state.actionStates.clear();
            break;
        case 6:
            for (ActionState& action : state.actionStates)
            {
                action.actionStatus = static_cast<EActionStatus>(choices.Take(6));
            }
            break;
        case 7:
            state.actionStates.push_back(ActionState{
                (choices.Take(2) == 0 ? "a" : "i") + std::to_string(choices.Take(8)),
                "pick",
                {},
                static_cast<EActionStatus>(choices.Take(6)),
                "result"});
            break;
        case 8:
            state.header.headerID = choices.Take(2) == 0 ? 0 : ~0U;
            state.header.timestamp += std::chrono::hours(choices.Take(3)) - std::chrono::hours(1);
            break;
        case 9:
            state.operatingMode = static_cast<EOperatingMode>(choices.Take(5));
            break;
        case 10:
            AddMany(state, choices);
            break;
        case 11:
            state.header.serialNumber = "LR02";
            break;
        case 12:
            state.header.version = choices.Take(2) == 0 ? "3.0.0" : std::string(200, '2');
            break;
        case 13:
            state.loads = {Load{"L1", "box", {}, {}, {}, 1.0}, Load{}};
            state.agvPosition = AgvPosition{};
            break;
        default:
            state.errors.push_back(MakeError(state, choices));
            break;
    }
}

void SendState(Fuzz::MasterOwner& owner, Fuzz::Choices& choices)
{
    StateMessage state = owner.MakeState();
    const bool bTrue = choices.Take(4) != 1;
    for (std::uint32_t left = bTrue ? 0 : 1 + choices.Take(3); left > 0; --left)
    {
        Distort(state, choices);
    }
    Vda5050Codec codec;
    std::string payload = codec.Encode(state, EVda5050Version::Version200);
    if (!bTrue && choices.Take(4) == 1)
    {
        const std::size_t high = choices.TakeByte();
        const std::size_t low = choices.TakeByte();
        payload[(high * 256 + low) % payload.size()] = static_cast<char>(choices.TakeByte());
    }
    owner.Receive(ETopic::State, payload, !bTrue && choices.Take(8) == 1);
}

/// Something that happens to the vehicle or to its connection.
void Happen(Fuzz::MasterOwner& owner, Fuzz::Choices& choices)
{
    Fuzz::VehicleModel& vehicle = owner.GetVehicle();
    switch (choices.Take(12))
    {
        case 0:
            vehicle.Restart();
            break;
        case 1:
        case 2:
            vehicle.SetMode(static_cast<EOperatingMode>(choices.Take(3)));
            break;
        case 3:
            vehicle.ClearErrors();
            break;
        case 4:
            owner.ChangeLink(false);
            break;
        case 5:
        case 6:
            owner.ChangeLink(true);
            break;
        case 7:
            owner.Receive(
                static_cast<ETopic>(choices.Take(TOPIC_COUNT)),
                choices.Take(2) == 0 ? "{}" : "[\xFF",
                choices.Take(2) == 0);
            break;
        default:
            owner.ReportConnection(static_cast<EConnectionState>(choices.Take(3)));
            break;
    }
}

void Call(Fuzz::MasterOwner& owner, Fuzz::Choices& choices)
{
    switch (choices.Take(16))
    {
        case 0:
        case 1:
        case 2:
        case 3:
        case 4:
            owner.SendOrder(choices);
            break;
        case 5:
        case 6:
        case 7:
        case 8:
            owner.SendUpdate(choices);
            break;
        case 9:
        case 10:
            owner.SendInstant(choices);
            break;
        case 11:
            owner.Cancel();
            break;
        case 12:
            owner.SetHorizonOmitted(choices.Take(2) == 0);
            break;
        case 13:
            owner.RestartMaster();
            break;
        default:
            owner.Resume();
            break;
    }
}

MasterOptions MakeOptions(Fuzz::Choices& choices)
{
    MasterOptions options;
    options.address = VehicleAddress{"uagv", "ACS", "LR01"};
    options.version = choices.Take(2) == 0 ? EVda5050Version::Version200 : EVda5050Version::Version210;
    options.resendInterval = std::chrono::milliseconds(200);
    options.resendCount = choices.Take(2) == 0 ? 0 : 1 + choices.Take(3);
    options.stateInterval = std::chrono::milliseconds(1'000);
    options.stateMargin = std::chrono::milliseconds(500);
    options.bStateRequested = choices.Take(2) == 0;
    if (choices.Take(4) == 1)
    {
        FactsheetMessage factsheet;
        factsheet.protocolLimits.timing.minOrderInterval = choices.Take(4) * 0.1;
        factsheet.protocolLimits.maxArrayLengths.orderNodes = 3 + choices.Take(3);
        factsheet.protocolLimits.maxArrayLengths.instantActions = choices.Take(3);
        options.factsheet = std::move(factsheet);
    }
    return options;
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
    Fuzz::Choices choices(data, size);
    Fuzz::MasterOwner owner(MakeOptions(choices));
    owner.ChangeLink(true);
    owner.ReportConnection(EConnectionState::Online);
    while (!choices.IsUsedUp())
    {
        switch (choices.Take(16))
        {
            case 0:
            case 1:
            case 2:
            case 3:
                SendState(owner, choices);
                break;
            case 4:
            case 5:
                owner.GetVehicle().Drive();
                break;
            case 6:
            case 7:
                owner.GetVehicle().AdvanceAction(choices.TakeByte(), choices.Take(4) == 1);
                break;
            case 8:
            case 9:
                owner.Transport(choices.Take(8) == 1);
                break;
            case 10:
            case 11:
            case 12:
                Call(owner, choices);
                break;
            case 13:
                owner.PassTime(std::chrono::milliseconds(choices.TakeByte()));
                break;
            case 14:
                owner.PassTime(std::chrono::milliseconds(choices.TakeByte() * 10U));
                break;
            default:
                Happen(owner, choices);
                break;
        }
    }
    owner.End();
    return 0;
}
