#include "VehicleSessionFixture.hpp"

#include "Catch.hpp"
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/Vda5050Codec.hpp>

#include <algorithm>
#include <utility>

namespace ACS::VDA5050::Test
{

VehicleOptions VehicleSessionFixture::MakeOptions()
{
    VehicleOptions options;
    options.address = MakeAddress();
    options.initialNodeID = "N0";
    options.minimumStateInterval = std::chrono::milliseconds(0);
    return options;
}

VehicleOptions VehicleSessionFixture::MakeOptionsOfStandard()
{
    VehicleOptions options = MakeOptions();
    options.factsheet.protocolFeatures.agvActions = GetPredefinedActions();
    return options;
}

VehicleSessionFixture::VehicleSessionFixture(VehicleOptions options)
    : _session(std::move(options))
{
    StandAt(0.0);
    _session.OnLinkUp(_clock.GetNow(), _out);
    Clear();
}

VehicleSessionFixture::~VehicleSessionFixture()
{
    CheckPublished(_out);
}

VehicleSession& VehicleSessionFixture::GetSession()
{
    return _session;
}

Core::Now VehicleSessionFixture::GetNow() const
{
    return _clock.GetNow();
}

const VehicleActions& VehicleSessionFixture::GetOutput() const
{
    return _out;
}

void VehicleSessionFixture::Clear()
{
    CheckPublished(_out);
    _out.clear();
}

void VehicleSessionFixture::Advance(std::chrono::milliseconds span)
{
    _clock.Advance(span);
}

void VehicleSessionFixture::Order(OrderMessage order)
{
    order.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    Payload(ETopic::Order, Vda5050Codec().Encode(order, EVda5050Version::Version200));
}

void VehicleSessionFixture::Payload(ETopic topic, std::string_view payload, bool bRetained)
{
    _session.OnMessage(BuildTopic(MakeAddress(), topic), payload, bRetained, _clock.GetNow(), _out);
}

void VehicleSessionFixture::Instant(
    std::string_view actionType,
    const std::string& actionID,
    std::vector<ActionParameter> parameters)
{
    Action action = MakeAction(actionID, EBlockingType::Hard, std::string(actionType));
    action.actionParameters = std::move(parameters);
    Instant({std::move(action)});
}

void VehicleSessionFixture::Instant(std::vector<Action> actions)
{
    InstantActionsMessage message;
    message.header = Header{_headerID++, _clock.GetNow().wall, "2.0.0", "ACS", "LR01"};
    message.actions = std::move(actions);
    Payload(ETopic::InstantActions, Vda5050Codec().Encode(message, EVda5050Version::Version200));
}

void VehicleSessionFixture::Reach(std::uint32_t sequenceID, bool bStationary, std::vector<EdgeActionEnd> edgeActions)
{
    const bool bReached =
        _session.TryReachNode({sequenceID, bStationary, std::move(edgeActions)}, _clock.GetNow(), _out);
    CHECK(bReached);
}

void VehicleSessionFixture::Drive(bool bDriving)
{
    _session.OnDrivingChanged(bDriving, _clock.GetNow(), _out);
}

void VehicleSessionFixture::Status(std::string_view actionID, EActionStatus status)
{
    CHECK(_session.TrySetActionStatus(actionID, status, {}, _clock.GetNow(), _out));
}

void VehicleSessionFixture::StandAt(double x, double theta)
{
    AgvPosition position;
    position.bPositionInitialized = true;
    position.x = x;
    position.theta = theta;
    position.mapID = "floor";
    _session.OnPosition(position, Velocity{});
}

void VehicleSessionFixture::Mode(EOperatingMode mode)
{
    _session.OnOperatingMode(mode, _clock.GetNow(), _out);
}

void VehicleSessionFixture::HardwarePause(bool bPaused, bool bOverridesMaster)
{
    _session.OnHardwarePause(bPaused, bOverridesMaster, _clock.GetNow(), _out);
}

std::vector<StateMessage> VehicleSessionFixture::GetPublishedStates() const
{
    std::vector<StateMessage> states;
    Vda5050Codec codec;
    for (const PublishMessage& publish : Pick<PublishMessage>(_out))
    {
        if (publish.message.topic == BuildTopic(MakeAddress(), ETopic::State))
        {
            Core::Result<StateMessage> state = codec.Decode<StateMessage>(publish.message.payload);
            REQUIRE(state.has_value());
            states.push_back(std::move(*state));
        }
    }
    return states;
}

StateMessage VehicleSessionFixture::GetPublishedState() const
{
    const std::vector<StateMessage> states = GetPublishedStates();
    return states.empty() ? _session.GetState() : states.back();
}

std::vector<std::string> VehicleSessionFixture::GetStartedActions() const
{
    std::vector<std::string> ids;
    for (const StartAction& start : Pick<StartAction>(_out))
    {
        ids.push_back(start.action.actionID);
    }
    return ids;
}

EActionStatus VehicleSessionFixture::GetStatus(std::string_view actionID) const
{
    const StateMessage state = _session.GetState();
    const auto found = std::ranges::find(state.actionStates, actionID, &ActionState::actionID);
    REQUIRE(found != state.actionStates.end());
    return found->actionStatus;
}

bool VehicleSessionFixture::HasError(std::string_view errorType) const
{
    const StateMessage state = GetPublishedState();
    return std::ranges::find(state.errors, errorType, &VehicleError::errorType) != state.errors.end();
}

} // namespace ACS::VDA5050::Test
