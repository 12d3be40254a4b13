#include "control/StoreLogWatch.hpp"
#include "engine/PlanEngine.Impl.hpp"

#include <algorithm>
#include <cassert>
#include <utility>
#include <variant>

namespace ACS::Planning
{

namespace
{

/// If a batch cannot be stored, plans and controls are refused; commands of the operator stay in effect.
[[maybe_unused]] bool CanShareTransaction(std::span<const OfferedCommand> commands)
{
    const auto isPlan = [](const OfferedCommand& offered) {
        return std::holds_alternative<SubmitPlan>(offered.command);
    };
    const auto isOfMCS = [&isPlan](const OfferedCommand& offered) {
        return isPlan(offered) || std::holds_alternative<ControlPlan>(offered.command);
    };
    return std::ranges::all_of(commands, isPlan) || std::ranges::none_of(commands, isOfMCS);
}

} // namespace

PlanEngine::PlanEngine(EngineOptions options, SiteMap site, Core::IRandom& random)
    : _impl(std::make_unique<Impl>(std::move(options), std::move(site), random))
{
}

PlanEngine::~PlanEngine() = default;

void PlanEngine::AddObserver(IPlanObserver& observer)
{
    _impl->_engine.transaction.AddObserver(observer);
}

void PlanEngine::Restore(StoredState state, Core::Now now, EngineActions& out)
{
    _impl->Begin(now);
    _impl->_operator.GetBlocks().Restore(std::move(state.blocks));
    _impl->_recovery.Restore(std::move(state));
    _impl->End(out);
}

void PlanEngine::Handle(const PlanCommand& command, Core::Now now, EngineActions& out)
{
    const OfferedCommand offered{command};
    Handle({&offered, 1}, now, out);
}

void PlanEngine::Handle(std::span<const OfferedCommand> commands, Core::Now now, EngineActions& out)
{
    const auto isAcknowledgement = [](const OfferedCommand& offered) {
        return std::holds_alternative<MessageAcknowledged>(offered.command);
    };
    assert(commands.size() == 1 || CanShareTransaction(commands));
    _impl->Begin(now);
    EngineTransaction& transaction = _impl->_engine.transaction;
    for (const OfferedCommand& offered : commands)
    {
        _impl->HandleCommand(offered.command);
        if (offered.receipt.has_value() && transaction.HasAcceptedCommand())
        {
            transaction.Store(ReceiptAdded{*offered.receipt});
        }
    }
    if (!std::ranges::all_of(commands, isAcknowledgement))
    {
        _impl->_places.NoteAllMovable();
    }
    _impl->End(out);
}

void PlanEngine::Handle(std::string_view robotID, const RobotEvent& event, Core::Now now, EngineActions& out)
{
    Robot* robotOrNull = _impl->_engine.fleet.FindOrNull(robotID);
    if (robotOrNull == nullptr)
    {
        return;
    }
    _impl->Begin(now);
    Robot& robot = *robotOrNull;
    robot.changes.MarkStatus();
    robot.changes.MarkWork();
    _impl->HandleEvent(robot, event);
    _impl->_places.NoteMovable(robot);
    _impl->End(out);
}

void PlanEngine::OnTimer(const EngineTimer& timer, Core::Now now, EngineActions& out)
{
    _impl->Begin(now);
    _impl->OnEngineTimer(timer.kind);
    if (Robot* robotOrNull = _impl->_engine.fleet.FindOrNull(timer.robotID); robotOrNull != nullptr)
    {
        _impl->OnRobotTimer(timer.kind, *robotOrNull);
        _impl->_places.NoteMovable(*robotOrNull);
    }
    _impl->End(out);
}

void PlanEngine::OnStored(const Core::Result<void>& result, Core::Now now, EngineActions& out)
{
    _impl->_store.OnStored(result, now, out);
}

bool PlanEngine::IsStoring() const noexcept
{
    return _impl->_store.IsStoring();
}

void PlanEngine::OnStoreLost(std::string_view reason, Core::Now now, EngineActions& out)
{
    _impl->_store.OnStoreLost(reason, now, out);
}

void PlanEngine::OnStoreLog(const StoreLog& log, Core::Now now, EngineActions& out)
{
    _impl->Begin(now);
    StoreLogWatch(_impl->_engine).OnStoreLog(log);
    _impl->End(out);
}

} // namespace ACS::Planning
