#include "robots/JobData.hpp"

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <string_view>

namespace ACS::Acsd
{

namespace
{

using ESubject = JobName::ESubject;

std::optional<Core::Location> ParseOrNull(const std::optional<std::string>& text)
{
    if (!text.has_value())
    {
        return std::nullopt;
    }
    const Core::Result<Core::Location> location = Core::Location::Parse(*text);
    return location.has_value() ? std::optional(*location) : std::nullopt;
}

/// The number of the last such segment, as for a tray port in a cassette port; 0 without one.
std::int64_t GetSegmentNumber(const Core::Location& location, Core::ESegmentKind kind)
{
    std::int64_t number = 0;
    for (const Core::LocationSegment& segment : location.GetSegments())
    {
        number = segment.kind == kind ? segment.number : number;
    }
    return number;
}

/// The carrier port of a place on a robot: "CR01.TP01" of "CR01.TP01.MP03".
std::string MakePortText(const Core::Location& place)
{
    const std::string& text = place.GetText();
    return place.IsMemoryPort() ? text.substr(0, text.rfind('.')) : text;
}

/// The innermost station of the table that is the place or contains it; null if there is none.
const StationTable::value_type* FindStationOfOrNull(const StationTable& stations, const Core::Location& place)
{
    std::string_view text = place.GetText();
    while (!text.empty())
    {
        if (const auto station = stations.find(text); station != stations.end())
        {
            return &*station;
        }
        const std::size_t dot = text.rfind('.');
        text = text.substr(0, dot == std::string_view::npos ? 0 : dot);
    }
    return nullptr;
}

} // namespace

JobData::JobData(const Planning::StartJob& job, const StationTable& stations, const LoadPositions& positions)
    : _from(ParseOrNull(job.from)),
      _to(ParseOrNull(job.to)),
      _position(ParseOrNull(job.position)),
      _positionText(job.position),
      _carrierID(job.carrierID),
      _jobNumber(job.jobNumber)
{
    const Core::Location* const place = FindPlaceOrNull();
    if (const auto* const own = place == nullptr ? nullptr : FindStationOfOrNull(stations, *place))
    {
        _stationID = own->first;
        _stationOrNull = &own->second;
    }
    else
    {
        const auto station = stations.find(job.position);
        _stationID = job.position;
        _stationOrNull = station == stations.end() ? nullptr : &station->second;
    }
    if (const Core::Location* const robotPlace = FindRobotPlaceOrNull())
    {
        const std::string port = MakePortText(*robotPlace);
        const std::string* const position = positions.FindPositionOrNull(port);
        _robotPosition = position == nullptr ? port.substr(port.find('.') + 1) : *position;
    }
}

const std::string& JobData::GetStationID() const noexcept
{
    return _stationID;
}

const std::optional<Core::Location>& JobData::GetLocation(ESubject subject) const
{
    if (subject == ESubject::Position)
    {
        return _position;
    }
    return subject == ESubject::To ? _to : _from;
}

const Core::Location* JobData::FindPlaceOrNull() const
{
    for (const std::optional<Core::Location>* place : {&_from, &_to})
    {
        if (place->has_value() && !(*place)->IsRobotPort())
        {
            return &**place;
        }
    }
    return nullptr;
}

const Core::Location* JobData::FindRobotPlaceOrNull() const
{
    for (const std::optional<Core::Location>* place : {&_from, &_to})
    {
        if (place->has_value() && (*place)->IsRobotPort())
        {
            return &**place;
        }
    }
    return nullptr;
}

std::optional<JobValue> JobData::FindStationValueOrNull(const std::string& key) const
{
    if (_stationOrNull == nullptr)
    {
        return std::nullopt;
    }
    const auto value = _stationOrNull->find(key);
    return value == _stationOrNull->end() ? std::nullopt : std::optional(value->second);
}

std::optional<JobValue> JobData::FindOrNull(const JobName& name) const
{
    if (name.segment.has_value())
    {
        return JobValue(GetNumber(name));
    }
    switch (name.subject)
    {
        case ESubject::Position:
            return JobValue(_positionText);
        case ESubject::From:
        case ESubject::To:
        {
            const std::optional<Core::Location>& place = GetLocation(name.subject);
            return place.has_value() ? std::optional<JobValue>(place->GetText()) : std::nullopt;
        }
        case ESubject::Place:
        {
            const Core::Location* const place = FindPlaceOrNull();
            return JobValue(place == nullptr ? _positionText : place->GetText());
        }
        case ESubject::Carrier:
            return _carrierID.has_value() ? std::optional<JobValue>(*_carrierID) : std::nullopt;
        case ESubject::RobotPort:
            return _robotPosition.has_value() ? std::optional<JobValue>(*_robotPosition) : std::nullopt;
        case ESubject::JobNumber:
            return JobValue(std::int64_t{_jobNumber});
        case ESubject::Station:
            return FindStationValueOrNull(name.key);
        default:
            return std::nullopt;
    }
}

std::int64_t JobData::GetNumber(const JobName& name) const
{
    if (name.subject == ESubject::JobNumber)
    {
        return _jobNumber;
    }
    if (name.subject == ESubject::Station)
    {
        const std::optional<JobValue> value = FindStationValueOrNull(name.key);
        const auto* const number = value.has_value() ? std::get_if<std::int64_t>(&*value) : nullptr;
        return number == nullptr ? 0 : *number;
    }
    if (name.subject == ESubject::RobotPort)
    {
        const Core::Location* const port = FindRobotPlaceOrNull();
        return port == nullptr ? 0 : port->GetSegments()[1].number;
    }
    const std::optional<Core::Location>& place = GetLocation(name.subject);
    return place.has_value() && name.segment.has_value() ? GetSegmentNumber(*place, *name.segment) : 0;
}

} // namespace ACS::Acsd
