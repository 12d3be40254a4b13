#include "robot/PortLedger.hpp"

#include <acs/core/ControlCharacter.hpp>
#include <acs/plan/Plan.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <utility>

namespace ACS::Planning
{

namespace
{

constexpr const char* NO_CARRIER = "no carrier";

/// An ID that an operator could not enter does not count.
bool HasID(const PortLoad& load)
{
    return !load.carrierID.empty() && load.carrierID.size() <= MAXIMUM_ID_LENGTH
        && !Core::HasControlCharacter(load.carrierID) && load.carrierID != UNKNOWN_CARRIER;
}

/// A load without an ID contradicts no ID, and only an empty port contradicts an unknown carrier.
bool IsAgreed(const std::optional<std::string>& expectedOrNull, const PortLoad& load)
{
    if (!load.bLoaded || !expectedOrNull.has_value())
    {
        return load.bLoaded == expectedOrNull.has_value();
    }
    return !HasID(load) || *expectedOrNull == UNKNOWN_CARRIER || *expectedOrNull == load.carrierID;
}

/// The other ports at which the load's carrier is reported ("CR01.TP02, CR01.TP03").
std::string ListOtherPorts(const std::vector<PortLoad>& loads, const PortLoad& load)
{
    std::string ports;
    for (const PortLoad& other : loads)
    {
        if (load.bLoaded && HasID(load) && other.bLoaded && other.port != load.port
            && other.carrierID == load.carrierID)
        {
            ports += (ports.empty() ? "" : ", ") + other.port;
        }
    }
    return ports;
}

std::optional<std::string> MergeOrNull(const std::optional<std::string>& knownOrNull, const PortLoad& load)
{
    if (!load.bLoaded)
    {
        return std::nullopt;
    }
    return HasID(load) ? load.carrierID : knownOrNull.value_or(std::string(UNKNOWN_CARRIER));
}

} // namespace

PortLedger::PortLedger(std::span<const Core::Location> ports)
    : _ports(ports),
      _carriers(ports.size())
{
}

void PortLedger::Restore(const CarriersChanged& record)
{
    if (record.ports.empty() && record.carrierIDs.size() == _ports.size())
    {
        _carriers = record.carrierIDs;
        return;
    }
    std::vector<bool> isKnown(_ports.size(), false);
    for (std::size_t i = 0; i < record.carrierIDs.size(); ++i)
    {
        const std::string name = i < record.ports.size() ? record.ports[i] : fmt::format("port {}", i + 1);
        const std::optional<std::string>& carrier = record.carrierIDs[i];
        if (const std::optional<std::size_t> port = FindPortOrNull(name); port.has_value())
        {
            isKnown[*port] = true;
            _carriers[*port] = carrier;
        }
        else if (carrier.has_value())
        {
            _stranded.emplace(name, *carrier);
        }
    }
    for (std::size_t port = 0; port < _ports.size() && !_stranded.empty(); ++port)
    {
        if (!isKnown[port])
        {
            _carriers[port] = UNKNOWN_CARRIER;
        }
    }
}

void PortLedger::Correct(CarrierIDs carriers)
{
    assert(carriers.size() == _ports.size());
    _carriers = std::move(carriers);
    _stranded.clear();
    _disputes.clear();
}

void PortLedger::ForgetDisputes()
{
    _disputes.clear();
}

PortLedger::Comparison PortLedger::Compare(std::span<const PortLoad> loads, std::span<const PortUse> openUses)
{
    const CarrierIDs recorded = _carriers;
    const bool bWasDisputed = IsDisputed();
    std::vector<std::size_t> ports;
    std::vector<PortLoad> evidence;
    for (const PortLoad& load : loads)
    {
        const std::optional<std::size_t> port = FindPortOrNull(load.port);
        if (port.has_value() && std::ranges::count(openUses, *port, &PortUse::port) == 0)
        {
            ports.push_back(*port);
            evidence.push_back(load);
        }
    }
    for (std::size_t i = 0; i < evidence.size(); ++i)
    {
        CompareLoad(ports[i], evidence[i], ListOtherPorts(evidence, evidence[i]));
    }
    return {_carriers != recorded, bWasDisputed || IsDisputed()};
}

/// A carrier that is reported at two ports proves neither: both are loaded, and their recorded IDs stay.
void PortLedger::CompareLoad(std::size_t port, const PortLoad& load, const std::string& otherPorts)
{
    std::optional<std::string>& record = _carriers[port];
    auto dispute = _disputes.find(port);
    if (otherPorts.empty() && dispute != _disputes.end() && IsAgreed(dispute->second.expected, load)
        && (!IsAgreed(record, load) || record == dispute->second.expected))
    {
        record = MergeOrNull(dispute->second.expected, load); // the expected carrier is back
        _disputes.erase(dispute);
        return;
    }
    if (!otherPorts.empty() || !IsAgreed(record, load))
    {
        dispute = _disputes.try_emplace(port, Dispute{record, {}}).first;
    }
    record = MergeOrNull(record, otherPorts.empty() ? load : PortLoad{load.port, true, {}});
    if (dispute != _disputes.end())
    {
        dispute->second.reported = otherPorts.empty() ? record.value_or(NO_CARRIER)
                                                      : fmt::format("{}, also at {}", load.carrierID, otherPorts);
    }
}

std::string PortLedger::Move(std::span<const PortUse> uses, const std::optional<std::string>& carrierIDOrNull)
{
    std::optional<std::string> carrier = carrierIDOrNull;
    std::string contradiction;
    for (const PortUse& use : uses)
    {
        contradiction = contradiction.empty() ? DescribeContradiction(use, carrierIDOrNull) : contradiction;
        std::optional<std::string>& record = _carriers[use.port];
        if (use.bFills)
        {
            record = carrier.value_or(std::string(UNKNOWN_CARRIER));
        }
        else
        {
            carrier = carrier.has_value() ? carrier : record;
            record.reset();
        }
        _disputes.erase(use.port);
    }
    return contradiction;
}

std::string PortLedger::DescribeContradiction(const PortUse& use, const std::optional<std::string>& carrierIDOrNull)
    const
{
    const std::string& name = GetName(use.port);
    const std::optional<std::string>& carrier = _carriers[use.port];
    if (use.bFills)
    {
        return carrier.has_value() ? fmt::format(
                   "{} was loaded, but the record has {} there. Check the port and correct the record.",
                   name,
                   *carrier)
                                   : std::string();
    }
    if (!carrier.has_value())
    {
        return fmt::format(
            "{} was unloaded, but the record has no carrier there. Check the port and correct the record.",
            name);
    }
    const bool bOther = carrierIDOrNull.has_value() && carrier != carrierIDOrNull && carrier != UNKNOWN_CARRIER;
    return bOther ? fmt::format(
               "{} was unloaded from {}, but the record has {} there. Check the port and correct the record.",
               *carrierIDOrNull,
               name,
               *carrier)
                  : std::string();
}

bool PortLedger::TryBeginReportInterval()
{
    return !std::exchange(_bReportLimited, true);
}

void PortLedger::EndReportInterval()
{
    _bReportLimited = false;
}

const CarrierIDs& PortLedger::GetCarriers() const noexcept
{
    return _carriers;
}

std::string PortLedger::DescribeStranded() const
{
    std::string text;
    for (const auto& [port, carrier] : _stranded)
    {
        text += fmt::format("{}{} ({})", text.empty() ? "" : ", ", carrier, port);
    }
    return text;
}

CarriersChanged PortLedger::MakeRecord(const std::string& robotID) const
{
    CarriersChanged record{robotID, _carriers};
    for (const Core::Location& port : _ports)
    {
        record.ports.push_back(port.GetText());
    }
    for (const auto& [port, carrier] : _stranded)
    {
        record.ports.push_back(port);
        record.carrierIDs.emplace_back(carrier);
    }
    return record;
}

bool PortLedger::IsDisputed() const noexcept
{
    return !_disputes.empty();
}

std::string PortLedger::DescribeDisputes() const
{
    std::string text;
    for (const auto& [port, dispute] : _disputes)
    {
        text += fmt::format(
            "{}{}: expected {}, reported {}",
            text.empty() ? "" : "; ",
            GetName(port),
            dispute.expected.value_or(NO_CARRIER),
            dispute.reported);
    }
    return text;
}

const std::string& PortLedger::GetName(std::size_t port) const
{
    return _ports[port].GetText();
}

std::optional<std::size_t> PortLedger::FindPortOrNull(std::string_view name) const
{
    const auto found =
        std::ranges::find_if(_ports, [name](const Core::Location& port) { return port.GetText() == name; });
    return found == _ports.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - _ports.begin()));
}

std::optional<std::size_t> PortLedger::FindCarrierOrNull(const std::string& carrierID) const
{
    const auto found = std::ranges::find(_carriers, std::optional(carrierID));
    return found == _carriers.end() ? std::nullopt : std::optional(static_cast<std::size_t>(found - _carriers.begin()));
}

std::optional<std::size_t> PortLedger::FindMissingTrayOrNull(const Core::Location& place, const Contents& planned) const
{
    if (!place.IsMemoryPort() || !place.IsRobotPort())
    {
        return std::nullopt;
    }
    const std::string_view memory = place.GetText();
    const std::size_t begin = memory.find('.'); // after the name of the robot
    const std::string_view tray = memory.substr(begin, memory.rfind('.') - begin);
    const auto found = std::ranges::find_if(_ports, [tray](const Core::Location& port) {
        const std::string_view text = port.GetText();
        return text.substr(text.find('.')) == tray;
    });
    if (found == _ports.end())
    {
        return std::nullopt;
    }
    const auto port = static_cast<std::size_t>(found - _ports.begin());
    const auto known = planned.find(port);
    const bool bThere = known == planned.end() ? _carriers[port].has_value() : known->second;
    return bThere ? std::nullopt : std::optional(port);
}

} // namespace ACS::Planning
