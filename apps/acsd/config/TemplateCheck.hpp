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

/// Finds names in the templates of a configuration that have no value in any job.
class TemplateCheck final
{
    const StationTable& _stations;
    SitePlaces _places;
    std::map<Core::ESegmentKind, std::int64_t> _highest; ///< Highest number of each kind at this site and its robots.
    std::int64_t _highestRobotPort = 0;
    EArmRelayIndex _relayIndex;

public:
    /// The stations must outlive it.
    TemplateCheck(const StationTable& stations, const Planning::EngineOptions& engine, EArmRelayIndex relayIndex);

    [[nodiscard]] const SitePlaces& GetPlaces() const noexcept;

    /// The unit of relay numbers.
    [[nodiscard]] EArmRelayIndex GetRelayIndex() const noexcept;

    /// Why the name has no value in any job of the action: no station has the key, or no place has the number.
    [[nodiscard]] std::optional<std::string> FindFaultOrNull(const JobName& name, const Planning::ActionRule& rule)
        const;

    /// Likewise for the name of an input; also reports a value that the relay cannot hold.
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
