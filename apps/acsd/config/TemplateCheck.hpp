#pragma once

#include "config/SitePlaces.hpp"
#include "robots/JobMethod.hpp"
#include "robots/JobName.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstdint>
#include <map>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What the templates of a configuration cannot mean, whatever the job.
class TemplateCheck final
{
    const StationTable& _stations;
    SitePlaces _places;
    std::map<Core::ESegmentKind, std::int64_t> _highest; ///< Number of each kind at this site and its robots.
    std::int64_t _highestRobotPort = 0;
    EArmRelayIndex _relayIndex;

public:
    /// The stations must outlive it.
    TemplateCheck(const StationTable& stations, const Planning::EngineOptions& engine, EArmRelayIndex relayIndex);

    [[nodiscard]] const SitePlaces& GetPlaces() const noexcept;

    /// What the numbers of relays count.
    [[nodiscard]] EArmRelayIndex GetRelayIndex() const noexcept;

    /// Why the name means nothing in any job of the action: a key that no station has, or a number that no place has.
    [[nodiscard]] std::optional<std::string> FindFaultOrNull(const JobName& name, const Planning::ActionRule& rule)
        const;

    /// The same of the input's name, and values that its relay cannot hold.
    [[nodiscard]] std::optional<std::string> FindFaultOrNull(
        const ArmInputTemplate& input,
        const Planning::ActionRule& rule) const;

private:
    [[nodiscard]] std::optional<std::string> FindPlaceFaultOrNull(const JobName& name, const Planning::ActionRule& rule)
        const;
    [[nodiscard]] std::optional<std::string> FindStationFaultOrNull(const std::string& key) const;
    [[nodiscard]] std::optional<std::string> FindStationNumberFaultOrNull(const ArmInputTemplate& input) const;
    [[nodiscard]] std::int64_t GetHighest(const JobName& name) const;
    void Count(const Core::Location& place);
};

} // namespace ACS::Acsd
