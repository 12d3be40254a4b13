#pragma once

#include "Floor.hpp"
#include <acs/core/Now.hpp>
#include <acs/plan/Plan.hpp>
#include <acs/plan/Router.hpp>

#include <cstddef>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace ACS::Testing
{

/// A transport that is completed.
struct FinishedTransport
{
    double slowdown = 0;     ///< Its time divided by the time on an empty floor, from its start.
    double totalSeconds = 0; ///< Since it was submitted.
};

/// The transports of a floor, one plan each, and how long they take.
class TransportLog
{
    struct Transport
    {
        std::size_t demand = 0;
        Core::SteadyTime submitted;
        Core::SteadyTime begin;
        double idealSeconds = 0;
    };

    Planning::Router _router;
    std::vector<Demand> _demands;
    std::size_t _submitted = 0;
    std::map<std::string, Transport> _open; ///< By plan: submitted and not ended.
    std::vector<FinishedTransport> _finished;

public:
    /// The floor must outlive the log.
    TransportLog(const Floor& floor, std::uint64_t seed, std::size_t count, std::uint64_t priorities);

    /// Whether transports are left that were not submitted.
    [[nodiscard]] bool HasMore() const noexcept;
    [[nodiscard]] bool IsDone() const noexcept;
    [[nodiscard]] std::size_t CountOpen() const noexcept;
    /// The plan of the next transport.
    [[nodiscard]] Planning::Plan Submit(Core::SteadyTime now);
    /// The plan begins, with a vehicle on this node.
    void Begin(const std::string& planID, const std::string& nodeID, Core::SteadyTime now);
    void Complete(const std::string& planID, Core::SteadyTime now);

    /// Of an open plan.
    [[nodiscard]] const Demand& GetDemand(const std::string& planID) const;
    [[nodiscard]] std::vector<std::string> ListOpen() const;
    [[nodiscard]] const std::vector<FinishedTransport>& GetFinished() const noexcept;
    [[nodiscard]] double GetMeanSlowdown() const;

private:
    [[nodiscard]] double GetSeconds(const std::string& from, const std::string& to) const;
};

} // namespace ACS::Testing
