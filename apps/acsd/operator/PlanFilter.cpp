#include "operator/PlanFilter.hpp"

#include "view/PlanViewMaker.hpp"
#include <acs/core/ECoreError.hpp>
#include <acs/core/ParseNumber.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <iterator>
#include <limits>
#include <string_view>

namespace ACS::Acsd
{

Core::Result<PlanFilter> PlanFilter::Read(const Apps::HttpRequest& request)
{
    PlanFilter filter;
    const std::string state = request.GetQueryOrNull("state").value_or("unfinished");
    constexpr std::array<std::string_view, 4> WORDS{"unfinished", "active", "waiting", "finished"};
    const auto* const word = std::ranges::find(WORDS, state);
    if (word == WORDS.end())
    {
        return Core::Fail(
            Core::ECoreError::UnknownWord,
            "state",
            "unfinished, active, waiting or finished",
            Core::QuoteForError(state));
    }
    filter._stage = static_cast<EStage>(word - WORDS.begin());
    filter._robotID = request.GetQueryOrNull("robot");
    filter._lotID = request.GetQueryOrNull("lot");
    if (const std::optional<std::string> text = request.GetQueryOrNull("limit"))
    {
        filter._limit = Core::ParseNumberOrNull<std::size_t>(*text).value_or(0);
        if (filter._limit == 0 || filter._limit > MOST_PLANS)
        {
            return Core::Fail(
                Core::ECoreError::OutOfRange,
                "limit",
                fmt::format("1 to {}", MOST_PLANS),
                Core::QuoteForError(*text));
        }
    }
    return filter;
}

std::vector<PlanView> PlanFilter::List(const Planning::PlanEngine& engine, const StateView& state) const
{
    std::vector<PlanView> plans;
    if (_stage != EStage::Finished)
    {
        std::ranges::copy_if(state.plans, std::back_inserter(plans), [this](const PlanView& plan) {
            return IsMeant(plan) && (_stage != EStage::Active || plan.robotID.has_value())
                && (_stage != EStage::Waiting || !plan.robotID.has_value());
        });
        plans.resize(std::min(plans.size(), _limit));
        return plans;
    }
    for (const Planning::PlanRecord& record : engine.GetFinishedPlanRecords(std::numeric_limits<std::size_t>::max()))
    {
        PlanView plan = MakePlanView(record, EPlanDetail::Steps);
        if (IsMeant(plan))
        {
            plans.push_back(std::move(plan));
        }
        if (plans.size() == _limit)
        {
            break;
        }
    }
    return plans;
}

bool PlanFilter::IsMeant(const PlanView& plan) const
{
    return (!_robotID.has_value() || plan.robotID == _robotID) && (!_lotID.has_value() || plan.lotID == *_lotID);
}

} // namespace ACS::Acsd
