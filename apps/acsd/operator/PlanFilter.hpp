#pragma once

#include "common/http/HttpMessage.hpp"
#include "view/StateView.hpp"
#include <acs/core/Result.hpp>
#include <acs/plan/PlanEngine.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// Which plans GET /v1/plans lists.
class PlanFilter final
{
public:
    static constexpr std::size_t DEFAULT_LIMIT = 100;
    static constexpr std::size_t MOST_PLANS = 1'000;

private:
    enum class EStage : std::uint8_t
    {
        Unfinished,
        Active, ///< A robot has the plan.
        Waiting,
        Finished
    };

    EStage _stage = EStage::Unfinished;
    std::optional<std::string> _robotID;
    std::optional<std::string> _lotID;
    std::size_t _limit = DEFAULT_LIMIT;

public:
    /// Reads state, robot, lot and limit from the query. The error is a sentence.
    [[nodiscard]] static Core::Result<PlanFilter> Read(const Apps::HttpRequest& request);

    /// Finished plans with the one that ended last first; the others in the order of the state.
    [[nodiscard]] std::vector<PlanView> List(const Planning::PlanEngine& engine, const StateView& state) const;

private:
    [[nodiscard]] bool IsMeant(const PlanView& plan) const;
};

} // namespace ACS::Acsd
