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

std::string MakeKey(const VehicleAddress& address)
{
    return std::string(CutTopic(BuildTopic(address, ETopic::State)));
}

} // namespace

MasterFleet::MasterFleet(FleetOptions options)
    : _options(std::move(options))
{
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

void MasterFleet::Append(std::size_t vehicle, FleetActions& out)
{
    for (MasterAction& action : _scratch)
    {
        out.push_back(FleetAction{vehicle, std::move(action)});
    }
    _scratch.clear();
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
    const std::size_t vehicle = _sessions.size();
    _numbers.emplace(MakeKey(session->GetOptions().address), vehicle);
    _sessions.push_back(std::move(session));
    return vehicle;
}

Core::Result<std::size_t> MasterFleet::Add(const VehicleAddress& address, Core::Now now, FleetActions& out)
{
    if (!IsValidAddress(address))
    {
        return Core::Fail(
            EVda5050Error::InvalidTopic,
            {},
            "names that may stand in a topic",
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
        _sessions.back()->OnLinkUp(now, _scratch);
        Append(vehicle, out);
    }
    return vehicle;
}

void MasterFleet::LeaveOut(const MqttMessage& message, Core::Error reason)
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
    if (_sessions.size() >= _options.maxVehicles)
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
    const bool bTells = topic
        && (topic->topic == ETopic::Connection || (topic->topic == ETopic::State && !message.bRetained))
        && topic->address.interfaceName == _options.vehicle.address.interfaceName;
    if (!bTells)
    {
        return; // a factsheet or a visualization: its connection message comes as well
    }
    const Core::Result<EVda5050Version> version = ReadVersion(message);
    if (!version)
    {
        LeaveOut(message, version.error());
        return;
    }
    std::unique_ptr<MasterSession> session = MakeSession(topic->address, *version);
    if (_bLinkUp)
    {
        session->OnLinkUp(now, _scratch);
    }
    session->OnMessage(message, now, _scratch);
    // What its own session refuses makes no vehicle known: anybody may write to a broker.
    for (const MasterAction& action : _scratch)
    {
        if (const auto* const refused = std::get_if<MessageRefused>(&action))
        {
            LeaveOut(message, refused->error);
            _scratch.clear();
            return;
        }
    }
    Append(Insert(std::move(session)), out);
}

void MasterFleet::OnLinkUp(Core::Now now, FleetActions& out)
{
    _bLinkUp = true;
    for (std::size_t vehicle = 0; vehicle < _sessions.size(); ++vehicle)
    {
        _sessions[vehicle]->OnLinkUp(now, _scratch);
        Append(vehicle, out);
    }
}

void MasterFleet::OnLinkDown(Core::Now now, FleetActions& out)
{
    _bLinkUp = false;
    for (std::size_t vehicle = 0; vehicle < _sessions.size(); ++vehicle)
    {
        _sessions[vehicle]->OnLinkDown(now, _scratch);
        Append(vehicle, out);
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
    _sessions.at(*number)->OnMessage(message, now, _scratch);
    Append(*number, out);
}

void MasterFleet::OnTimer(std::size_t vehicle, EMasterTimer timer, Core::Now now, FleetActions& out)
{
    GetSession(vehicle).OnTimer(timer, now, _scratch);
    Append(vehicle, out);
}

std::size_t MasterFleet::GetSize() const noexcept
{
    return _sessions.size();
}

MasterSession& MasterFleet::GetSession(std::size_t vehicle)
{
    assert(vehicle < _sessions.size());
    return *_sessions[vehicle];
}

const MasterSession& MasterFleet::GetSession(std::size_t vehicle) const
{
    assert(vehicle < _sessions.size());
    return *_sessions[vehicle];
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
    for (const std::unique_ptr<MasterSession>& session : _sessions)
    {
        const MasterStatistics& one = session->GetStatistics();
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
