#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What the vehicle's loads are to show when a job is done.
class LoadCheck final
{
    std::string _jobID;
    std::optional<std::string> _loadedPort;
    std::string _carrierID; ///< In the loaded port; empty: any.
    std::optional<std::string> _emptiedPort;

public:
    LoadCheck(const Planning::StartJob& job, Planning::EActionEffect effect);

    [[nodiscard]] const std::string& GetJobID() const noexcept;

    /// Port, expected and shown, for a person; nullopt where the loads agree. A carrier without an id is the right one.
    [[nodiscard]] std::optional<std::string> FindContradictionOrNull(
        const std::vector<Planning::PortLoad>& loads) const;
};

} // namespace ACS::Acsd
