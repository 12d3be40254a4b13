#include "engine/InputQueue.hpp"
#include <acs/core/Overloaded.hpp>
#include <acs/plan/PlanEngineHost.hpp>

#include <algorithm>
#include <iterator>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Planning
{

namespace
{

constexpr std::string_view CLOSED = "The ACS is shutting down.";
constexpr std::string_view FULL =
    "The ACS has not stored earlier requests yet. Send the request again later, with a new transactionId.";

} // namespace

PlanEngineHost::PlanEngineHost(
    PlanEngine& engine,
    const Core::IClock& clock,
    ExecuteHandler execute,
    StoreHandler store,
    const InputLimits& limits)
    : _engine(engine),
      _clock(clock),
      _execute(std::move(execute)),
      _store(std::move(store)),
      _inputs(std::make_unique<InputQueue>(limits))
{
}

PlanEngineHost::~PlanEngineHost() = default;

void PlanEngineHost::Restore(StoredState state)
{
    EngineActions actions;
    _engine.Restore(std::move(state), _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

void PlanEngineHost::Push(EngineInput input)
{
    const bool bQueued = !_bClosed && _inputs->TryPush(input);
    if (bQueued)
    {
        Work();
    }
    else if (const auto* const commandOrNull = std::get_if<PlanCommand>(&input); commandOrNull != nullptr)
    {
        Reject(*commandOrNull, _bClosed ? CLOSED : FULL);
    }
}

EInputAdmission PlanEngineHost::Offer(PlanCommand command, std::optional<CommandReceipt> receiptOrNull)
{
    if (_bClosed)
    {
        return EInputAdmission::Closed;
    }
    EngineInput input = std::move(command);
    if (!_inputs->TryPush(input, std::move(receiptOrNull)))
    {
        return EInputAdmission::Full;
    }
    Work();
    return EInputAdmission::Accepted;
}

void PlanEngineHost::OnStored(const Core::Result<void>& result)
{
    EngineActions actions;
    _engine.OnStored(result, _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

void PlanEngineHost::OnStoreLost(const Core::Error& error)
{
    if (IsStoring() || _bClosed)
    {
        return;
    }
    EngineActions actions;
    _engine.OnStoreLost(Core::Describe(error), _clock.GetNow(), actions);
    Append(std::move(actions));
    Work();
}

void PlanEngineHost::Close()
{
    _bClosed = true;
    for (const PlanCommand& command : _inputs->Clear())
    {
        Reject(command, CLOSED);
    }
}

bool PlanEngineHost::IsStoring() const noexcept
{
    return _engine.IsStoring();
}

std::size_t PlanEngineHost::GetWaitingCount() const noexcept
{
    return _inputs->GetCount();
}

/// R1: every request is answered. Nothing was begun, so the MCS may repeat it.
void PlanEngineHost::Reject(const PlanCommand& command, std::string_view reason) const
{
    std::visit(
        Core::Overloaded{
            [](const MessageAcknowledged&) { /* has no reply */ },
            [this, reason](const auto& request) {
                _execute(ReplyCommand{request.replyToken, false, std::string(reason)});
            }},
        command);
}

void PlanEngineHost::Work()
{
    if (std::exchange(_bWorking, true))
    {
        return; // an action or the store has called back: the loop below continues
    }
    while (!_actions.empty() || (!IsStoring() && !_inputs->IsEmpty()))
    {
        if (_actions.empty())
        {
            CallEngine();
        }
        else
        {
            ExecuteNext();
        }
    }
    _bWorking = false;
}

void PlanEngineHost::ExecuteNext()
{
    const EngineAction action = std::move(_actions.front());
    _actions.pop_front();
    if (const auto* const storeOrNull = std::get_if<StorePlans>(&action))
    {
        _store(storeOrNull->batch);
    }
    else
    {
        // The timer may have expired while the store worked, and wait in the queue. If it is to expire at once, it keeps its place:
        // behind inputs that arrive without end it would never come.
        if (const auto* const startOrNull = std::get_if<StartEngineTimer>(&action);
            startOrNull != nullptr && startOrNull->delay > Core::Duration::zero())
        {
            _inputs->Remove(startOrNull->timer);
        }
        else if (const auto* const cancelOrNull = std::get_if<CancelEngineTimer>(&action))
        {
            _inputs->Remove(cancelOrNull->timer);
        }
        _execute(action);
    }
}

void PlanEngineHost::CallEngine()
{
    const Core::Now now = _clock.GetNow();
    EngineActions actions;
    std::visit(
        Core::Overloaded{
            [&](const InputQueue::Commands& input) { _engine.Handle(input, now, actions); },
            [&](const RobotInput& robot) { _engine.Handle(robot.robotID, robot.event, now, actions); },
            [&](const EngineTimer& timer) { _engine.OnTimer(timer, now, actions); },
            [&](const StoreLog& log) {
                _engine.OnStoreLog(log, now, actions);
            }},
        _inputs->Pop());
    Append(std::move(actions));
}

void PlanEngineHost::Append(EngineActions actions)
{
    std::ranges::move(actions, std::back_inserter(_actions));
}

} // namespace ACS::Planning
