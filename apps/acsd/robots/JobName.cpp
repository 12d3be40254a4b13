#include "robots/JobName.hpp"

#include <acs/core/Result.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <utility>

namespace ACS::Acsd
{

namespace
{

using ESubject = JobName::ESubject;

constexpr std::string_view STATION_PREFIX = "station.";

constexpr std::array<std::pair<std::string_view, ESubject>, 7> SUBJECTS{
    {{"from", ESubject::From},
     {"to", ESubject::To},
     {"position", ESubject::Position},
     {"place", ESubject::Place},
     {"carrier", ESubject::Carrier},
     {"robot_port", ESubject::RobotPort},
     {"job_number", ESubject::JobNumber}}};

constexpr std::array<std::pair<std::string_view, Core::ESegmentKind>, 6> SEGMENTS{
    {{"area", Core::ESegmentKind::Area},
     {"st", Core::ESegmentKind::Stocker},
     {"cp", Core::ESegmentKind::CassettePort},
     {"tp", Core::ESegmentKind::TrayPort},
     {"set", Core::ESegmentKind::Set},
     {"mp", Core::ESegmentKind::MemoryPort}}};

bool HasSegments(ESubject subject)
{
    return subject == ESubject::From || subject == ESubject::To || subject == ESubject::Position;
}

/// The value of the name in a table of pairs.
template <typename TTable>
auto FindOrNull(const TTable& table, std::string_view word) -> std::optional<decltype(table[0].second)>
{
    const auto* const row = std::ranges::find(table, word, [](const auto& entry) { return entry.first; });
    return row == table.end() ? std::nullopt : std::optional(row->second);
}

template <typename TTable, typename TValue>
std::string_view FindWord(const TTable& table, TValue value)
{
    const auto* const row = std::ranges::find(table, value, [](const auto& entry) { return entry.second; });
    return row == table.end() ? std::string_view() : row->first;
}

} // namespace

tl::expected<JobName, std::string> ParseJobName(std::string_view text)
{
    if (text.starts_with(STATION_PREFIX) && text.size() > STATION_PREFIX.size())
    {
        return JobName{ESubject::Station, std::nullopt, std::string(text.substr(STATION_PREFIX.size()))};
    }
    const std::size_t dot = text.find('.');
    const std::optional<ESubject> subject = FindOrNull(SUBJECTS, text.substr(0, dot));
    if (subject.has_value() && dot == std::string_view::npos)
    {
        return JobName{*subject, std::nullopt, {}};
    }
    if (subject.has_value() && HasSegments(*subject))
    {
        const std::optional<Core::ESegmentKind> segment = FindOrNull(SEGMENTS, text.substr(dot + 1));
        if (segment.has_value())
        {
            return JobName{*subject, segment, {}};
        }
    }
    return tl::unexpected(fmt::format(
        "unknown name {}; known are from, to, place, position, carrier, robot_port, job_number, station.KEY, and area, "
        "st, cp, tp, set and mp of from, to and position, such as from.cp",
        Core::QuoteForError(text)));
}

std::string MakeNameText(const JobName& name)
{
    if (name.subject == ESubject::Station)
    {
        return fmt::format("{{{}{}}}", STATION_PREFIX, name.key);
    }
    const std::string_view subject = FindWord(SUBJECTS, name.subject);
    return name.segment.has_value() ? fmt::format("{{{}.{}}}", subject, FindWord(SEGMENTS, *name.segment))
                                    : fmt::format("{{{}}}", subject);
}

} // namespace ACS::Acsd
