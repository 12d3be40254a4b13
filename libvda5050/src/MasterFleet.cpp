#include <acs/vda5050/EVda5050Error.hpp>
#include <acs/vda5050/MasterFleet.hpp>

#include <array>
#include <cassert>
#include <utility>

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

std::size_t MasterFleet::Insert(
    const VehicleAddress& address,
    EVda5050Version version,
    Core::Now now,
    FleetActions& out)
{
    MasterOptions options = _options.vehicle;
    options.address = address;
    options.version = version;
    const std::size_t vehicle = _sessions.size();
    _sessions.push_back(std::make_unique<MasterSession>(std::move(options)));
    _numbers.emplace(MakeKey(address), vehicle);
    if (_bLinkUp)
    {
        _sessions.back()->OnLinkUp(now, _scratch);
        Append(vehicle, out);
    }
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
    return known.has_value() ? *known : Insert(address, _options.vehicle.version, now, out);
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
    const Core::Result<MessageIdentity> identity = _codec.DecodeIdentity(message.payload);
    const bool bRoom = _sessions.size() < _options.maxVehicles;
    const std::optional<EVda5050Version> version =
        identity ? ReadVersionOrNull(identity->header.version) : std::nullopt;
    const bool bNamesVersion = identity && !identity->header.version.empty();
    if (!_options.bDiscovery || !bRoom || !identity || (bNamesVersion && !version.has_value()))
    {
        ++_leftOut;
        return;
    }
    const std::size_t vehicle = Insert(topic->address, version.value_or(_options.vehicle.version), now, out);
    _sessions.at(vehicle)->OnMessage(message, now, _scratch);
    Append(vehicle, out);
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

} // namespace ACS::VDA5050
