#pragma once

#include <acs/plan/EngineOptions.hpp>
#include <acs/plan/RobotCommand.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// What reported loads prove about a job.
enum class ELoadEvidence : std::uint8_t
{
    Done,    ///< Each port is as after the job.
    NotDone, ///< Each port is as before the job.
    None,
};

/// The loads that the vehicle must report when a job is done.
class LoadCheck final
{
    std::string _jobID;
    std::optional<std::string> _loadedPort;
    std::string _carrierID; ///< Carrier in the loaded port; empty: any.
    std::optional<std::string> _emptiedPort;

public:
    LoadCheck(const Planning::StartJob& job, Planning::EActionEffect effect);

    [[nodiscard]] const std::string& GetJobID() const noexcept;

    /// A sentence with port, expected and reported load; nullopt if the loads agree. A carrier without an id agrees.
    [[nodiscard]] std::optional<std::string> FindContradictionOrNull(
        const std::vector<Planning::PortLoad>& loads) const;

    [[nodiscard]] ELoadEvidence GetEvidence(const std::vector<Planning::PortLoad>& loads) const;
};

} // namespace ACS::Acsd
