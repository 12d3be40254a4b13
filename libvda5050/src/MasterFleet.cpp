#include <acs/core/ECoreError.hpp>
#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterFleet.hpp>

#include <array>
#include <cassert>
#include <utility>
#include <variant>

namespace ACS::VDA5050
{

namespace
{

constexpr std::array LISTENED_TOPICS{ETopic::State, ETopic::Visualization, ETopic::Connection, ETopic::Factsheet};

/// "uagv/v2/KIT/0001" of "uagv/v2/KIT/0001/state": of which vehicle a topic is.
std::string_view CutTopic(std::string_view topic)
{
    const std::size_t end = topic.rfind('/');
    return topic.substr(0, end == std::string_view::npos ? 0 : end);
}

bool IsValidInterface(const FleetOptions& options)
{
    return IsValidAddress(VehicleAddress{options.vehicle.address.interfaceName, "any", "any"});
}

std::string MakeKey(const VehicleAddress& address)
{
    return std::string(CutTopic(BuildTopic(address, ETopic::State)));
}

} // namespace

void AppendActions(std::size_t vehicle, MasterActions& actions, FleetActions& out)
{
    for (MasterAction& action : actions)
    {
        out.push_back(FleetAction{vehicle, std::move(action)});
    }
    actions.clear();
}

MasterFleet::MasterFleet(FleetOptions options)
    : _options(std::move(options))
{
    assert(IsValidInterface(_options));
}

Core::Result<MasterFleet> MasterFleet::Create(FleetOptions options)
{
    if (!IsValidInterface(options))
    {
        return Core::Fail(
            EVda5050Error::InvalidTopic,
            "interfaceName",
            "a name that is allowed in a topic",
            Core::QuoteForError(options.vehicle.address.interfaceName));
    }
    return MasterFleet(std::move(options));
}

std::vector<MqttSubscription> MasterFleet::GetSubscriptions() const
{
    std::vector<MqttSubscription> subscriptions;
    const MasterOptions& vehicle = _options.vehicle;
    subscriptions.reserve(LISTENED_TOPICS.size());
    for (const ETopic topic : LISTENED_TOPICS)
    {
        subscriptions.push_back(
            MqttSubscription{BuildTopicFilter(vehicle.address.interfaceName, topic), vehicle.qos.Get(topic)});
    }
    return subscriptions;
}

const std::size_t* MasterFleet::FindNumberOrNull(std::string_view topic) const
{
    const auto found = _numbers.find(CutTopic(topic));
    return found == _numbers.end() ? nullptr : &found->second;
}

std::unique_ptr<MasterSession> MasterFleet::MakeSession(const VehicleAddress& address, EVda5050Version version) const
{
    MasterOptions options = _options.vehicle;
    options.address = address;
    options.version = version;
    return std::make_unique<MasterSession>(std::move(options));
}

std::size_t MasterFleet::Insert(std::unique_ptr<MasterSession> session)
{
    const std::size_t vehicle = _sessionsOrNull.size();
    _numbers.emplace(MakeKey(session->GetOptions().address), vehicle);
    _sessionsOrNull.push_back(std::move(session));
    return vehicle;
}

Core::Result<std::size_t> MasterFleet::Add(const VehicleAddress& address, Core::Now now, FleetActions& out)
{
    if (!IsValidAddress(address))
    {
        return Core::Fail(
            EVda5050Error::InvalidTopic,
            {},
            "names that are allowed in a topic",
            address.manufacturer + "/" + address.serialNumber);
    }
    const std::optional<std::size_t> known = FindOrNull(address);
    if (known.has_value())
    {
        return *known;
    }
    const std::size_t vehicle = Insert(MakeSession(address, _options.vehicle.version));
    if (_bLinkUp)
    {
        _sessionsOrNull.back()->OnLinkUp(now, _scratch);
        AppendActions(vehicle, _scratch, out);
    }
    return vehicle;
}

void MasterFleet::Ignore(const MqttMessage& message, Core::Error reason)
{
    ++_leftOut;
    _lastLeftOut = LeftOutMessage{message.topic, std::move(reason)};
}

Core::Result<EVda5050Version> MasterFleet::ReadVersion(const MqttMessage& message)
{
    if (!_options.bDiscovery)
    {
        return Core::Fail(EVda5050Error::InvalidTopic, {}, "a vehicle that was added", message.topic);
    }
    if (_numbers.size() >= _options.maxVehicles)
    {
        return Core::Fail(Core::ECoreError::QueueFull, {}, std::to_string(_options.maxVehicles) + " vehicles", "more");
    }
    const Core::Result<MessageIdentity> identity = _codec.DecodeIdentity(message.payload);
    if (!identity)
    {
        return tl::unexpected(identity.error());
    }
    const std::string& text = identity->header.version;
    const std::optional<EVda5050Version> version = ReadVersionOrNull(text);
    if (!text.empty() && !version.has_value())
    {
        return Core::Fail(EVda5050Error::UnsupportedVersion, "version", "2.x", text);
    }
    return version.value_or(_options.vehicle.version);
}

void MasterFleet::Discover(const MqttMessage& message, Core::Now now, FleetActions& out)
{
    const Core::Result<ParsedTopic> topic = ParseTopic(message.topic);
    const bool bShowsVehicle = topic
        && (topic->topic == ETopic::Connection || (topic->topic == ETopic::State && !message.bRetained))
        && topic->address.interfaceName == _options.vehicle.address.interfaceName;
    if (!bShowsVehicle)
    {
        return; // a factsheet or a visualization: its connection message comes as well
    }
    if (_options.bDiscovery && _options.isAccepted && !_options.isAccepted(topic->address))
    {
        Ignore(
            message,
            Core::Error{EVda5050Error::InvalidTopic, {}, "a vehicle that the application accepts", message.topic});
        return;
    }
    const Core::Result<EVda5050Version> version = ReadVersion(message);
    if (!version)
    {
        Ignore(message, version.error());
        return;
    }
    std::unique_ptr<MasterSession> session = MakeSession(topic->address, *version);
    if (_bLinkUp)
    {
        session->OnLinkUp(now, _scratch);
    }
    session->OnMessage(message, now, _scratch);
    // A message that its session would refuse makes no vehicle known: any client can publish on a broker.
    for (const MasterAction& action : _scratch)
    {
        if (const auto* const refused = std::get_if<MessageRefused>(&action))
        {
            Ignore(message, refused->error);
            _scratch.clear();
            return;
        }
    }
    AppendActions(Insert(std::move(session)), _scratch, out);
}

void MasterFleet::OnLinkUp(Core::Now now, FleetActions& out)
{
    _bLinkUp = true;
    for (const auto& [key, vehicle] : _numbers)
    {
        _sessionsOrNull[vehicle]->OnLinkUp(now, _scratch);
        AppendActions(vehicle, _scratch, out);
    }
}

void MasterFleet::OnLinkDown(Core::Now now, FleetActions& out)
{
    _bLinkUp = false;
    for (const auto& [key, vehicle] : _numbers)
    {
        _sessionsOrNull[vehicle]->OnLinkDown(now, _scratch);
        AppendActions(vehicle, _scratch, out);
    }
}

void MasterFleet::OnMessage(const MqttMessage& message, Core::Now now, FleetActions& out)
{
    const std::size_t* const number = FindNumberOrNull(message.topic);
    if (number == nullptr)
    {
        Discover(message, now, out);
        return;
    }
    _sessionsOrNull.at(*number)->OnMessage(message, now, _scratch);
    AppendActions(*number, _scratch, out);
}

void MasterFleet::OnTimer(std::size_t vehicle, EMasterTimer timer, Core::Now now, FleetActions& out)
{
    if (Contains(vehicle))
    {
        _sessionsOrNull[vehicle]->OnTimer(timer, now, _scratch);
        AppendActions(vehicle, _scratch, out);
    }
}

bool MasterFleet::TryRemove(std::size_t vehicle, FleetActions& out)
{
    if (!Contains(vehicle))
    {
        return false;
    }
    _numbers.erase(MakeKey(_sessionsOrNull[vehicle]->GetOptions().address));
    _sessionsOrNull[vehicle].reset();
    for (const EMasterTimer timer :
         {EMasterTimer::ResendOrder, EMasterTimer::ResendInstantActions, EMasterTimer::Silence})
    {
        out.push_back(FleetAction{vehicle, CancelMasterTimer{timer}});
    }
    return true;
}

bool MasterFleet::Contains(std::size_t vehicle) const noexcept
{
    return vehicle < _sessionsOrNull.size() && _sessionsOrNull[vehicle] != nullptr;
}

std::size_t MasterFleet::GetSize() const noexcept
{
    return _sessionsOrNull.size();
}

MasterSession& MasterFleet::GetSession(std::size_t vehicle)
{
    assert(Contains(vehicle));
    return *_sessionsOrNull[vehicle];
}

const MasterSession& MasterFleet::GetSession(std::size_t vehicle) const
{
    assert(Contains(vehicle));
    return *_sessionsOrNull[vehicle];
}

std::optional<std::size_t> MasterFleet::FindOrNull(const VehicleAddress& address) const
{
    const auto found = _numbers.find(MakeKey(address));
    return found == _numbers.end() ? std::nullopt : std::optional(found->second);
}

std::uint64_t MasterFleet::GetLeftOutCount() const noexcept
{
    return _leftOut;
}

const LeftOutMessage* MasterFleet::GetLastLeftOutOrNull() const noexcept
{
    return _lastLeftOut.has_value() ? &*_lastLeftOut : nullptr;
}

MasterStatistics MasterFleet::GetStatistics() const
{
    MasterStatistics sum;
    for (const auto& [key, vehicle] : _numbers)
    {
        const MasterStatistics& one = _sessionsOrNull[vehicle]->GetStatistics();
        sum.statesReceived += one.statesReceived;
        sum.statesIgnored += one.statesIgnored;
        sum.retainedIgnored += one.retainedIgnored;
        sum.messagesRefused += one.messagesRefused;
        sum.messagesSent += one.messagesSent;
        sum.ordersResent += one.ordersResent;
    }
    return sum;
}

} // namespace ACS::VDA5050
