#include "transaction/StoreBacklog.hpp"

#include <algorithm>
#include <iterator>
#include <utility>

namespace ACS::Planning
{

void StoreBacklog::OnFailed() noexcept
{
    _state = EState::Waiting;
}

bool StoreBacklog::TryFailAttempt() noexcept
{
    if (_state != EState::Attempted)
    {
        return false;
    }
    _state = EState::Waiting;
    return true;
}

void StoreBacklog::OnRetryDue() noexcept
{
    _state = _state == EState::Waiting ? EState::Due : _state;
}

void StoreBacklog::RestoreFailing() noexcept
{
    _state = EState::Due;
}

bool StoreBacklog::TryRecover() noexcept
{
    if (_state != EState::Attempted)
    {
        return false;
    }
    _state = EState::Working;
    return true;
}

bool StoreBacklog::IsWorthTrying(std::span<const StoreChange> changes) const
{
    return _state != EState::Waiting || std::ranges::any_of(changes, [](const StoreChange& change) {
               return std::holds_alternative<PlanAdded>(change);
           });
}

bool StoreBacklog::TryBeginAttempt() noexcept
{
    if (!IsFailing())
    {
        return false;
    }
    _state = EState::Attempted;
    return true;
}

void StoreBacklog::Add(std::vector<StoreChange> changes)
{
    std::ranges::move(changes, std::back_inserter(_changes));
}

std::vector<StoreChange> StoreBacklog::CollectChanges()
{
    return std::exchange(_changes, {});
}

void StoreBacklog::HoldBack(SendReport report)
{
    const auto replaced = std::ranges::find_if(_reports, [&report](const SendReport& other) {
        return report.replaced == other.entry.sequence;
    });
    if (replaced != _reports.end())
    {
        report.replaced = replaced->replaced;
        _reports.erase(replaced);
    }
    _reports.push_back(std::move(report));
}

std::vector<SendReport> StoreBacklog::CollectReports()
{
    return std::exchange(_reports, {});
}

void StoreBacklog::Withhold(ReplyCommand reply)
{
    if (_withheld.size() == MOST_WITHHELD)
    {
        _withheld.erase(_withheld.begin());
    }
    _withheld.push_back(std::move(reply));
}

void StoreBacklog::NoteUnknown(std::string planID)
{
    _refusedPlanIDs.insert(std::move(planID));
}

std::vector<ReplyCommand> StoreBacklog::CollectWithheld()
{
    _refusedPlanIDs.clear();
    return std::exchange(_withheld, {});
}

bool StoreBacklog::HasWithheld() const noexcept
{
    return !_withheld.empty();
}

bool StoreBacklog::HasUnknown(std::string_view planID) const
{
    return _refusedPlanIDs.contains(planID);
}

bool StoreBacklog::IsFailing() const noexcept
{
    return _state != EState::Working;
}

bool StoreBacklog::IsHeldBack(const OutboxEntry& report) const
{
    return std::ranges::binary_search(_reports, report.sequence, {}, [](const SendReport& held) {
        return held.entry.sequence;
    });
}

std::size_t StoreBacklog::CountHeldBack() const noexcept
{
    return _reports.size();
}

} // namespace ACS::Planning
