#include "drivers/RobotRunner.hpp"

#include "drivers/StateDefects.hpp"
#include <acs/acsd/IRobotSetup.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/protocol_beast/EWireDirection.hpp>

#include <fmt/format.h>

#include <algorithm>
#include <cassert>
#include <exception>
#include <iterator>
#include <stdexcept>
#include <utility>
#include <variant>

namespace ACS::Acsd
{

namespace
{

std::unique_ptr<IMqttService> MakeMqttService(
    const RobotRunner::Dependencies& dependencies,
    const RobotLinkConfig& link)
{
    if (link.topicPrefix.empty())
    {
        return nullptr;
    }
    assert(dependencies.mqttOrNull != nullptr);
    return dependencies.mqttOrNull->MakeService(link.robotID, link.topicPrefix);
}

/// The metrics of acsd's own drivers have whole names.
std::string MakeMetricPrefix(const std::string& driver)
{
    const bool bOwn = driver == VDA5050_DRIVER || driver == OPEN_STREAM_DRIVER;
    return bOwn ? std::string() : fmt::format("acsd_driver_{}_", driver);
}

tl::unexpected<RobotActionRefusal> RefuseAction(std::string sentence)
{
    return tl::make_unexpected(RobotActionRefusal{false, std::move(sentence)});
}

} // namespace

RobotRunner::RobotRunner(Dependencies dependencies, const RobotLinkConfig& link, EventHandler handler)
    : _dependencies(std::move(dependencies)),
      _robotID(link.robotID),
      _driver(link.driver),
      _ports(link.ports),
      _handler(std::move(handler)),
      _metrics(_dependencies.metrics, MakeMetricPrefix(link.driver), link.robotID),
      _mqtt(MakeMqttService(_dependencies, link)),
      _openStream(
          {_dependencies.executor,
           _dependencies.clock,
           _dependencies.random,
           _dependencies.logger,
           _dependencies.traceOrNull,
           _dependencies.mayCommand},
          link.robotID),
      _robot(link.setupOrNull->MakeRobot(MakeServices())),
      _ignored(_dependencies.logger.MakeFor("robot"), 1),
      _timers(_dependencies.executor, [this](Planning::AdapterTimerID timer) {
          Call([this, timer](Core::Now now, Planning::AdapterActions& out) {
              _robot->GetAdapter().OnTimer(timer, now, out);
          });
      })
{
}

void RobotRunner::Start()
{
    _robot->Start();
}

void RobotRunner::Stop()
{
    _bStopped = true;
    _timers.CancelAll();
    if (_mqtt != nullptr)
    {
        _mqtt->SetListener(nullptr);
    }
    _robot->Stop();
}

void RobotRunner::Handle(const Planning::RobotCommand& command)
{
    Call([this, &command](Core::Now now, Planning::AdapterActions& out) {
        _robot->GetAdapter().Handle(command, now, out);
    });
}

void RobotRunner::UpdateMetrics()
{
    if (!_bStopped)
    {
        _robot->UpdateMetrics();
    }
}

DriverDetails RobotRunner::GetDetails() const
{
    return _bStopped ? DriverDetails() : _robot->GetDetails();
}

tl::expected<std::string, RobotActionRefusal> RobotRunner::RequestAction(RobotActionRequest request, std::string reason)
{
    IRobotActions* const actionsOrNull = _robot->GetActionsOrNull();
    if (actionsOrNull == nullptr)
    {
        return RefuseAction(fmt::format("Robots of the driver {} have no instant actions.", _driver));
    }
    if (!_history.HasRoom())
    {
        return RefuseAction(
            fmt::format("{} instant actions of the robot have not ended.", ActionHistory::MOST_RECORDS));
    }
    tl::expected<std::string, RobotActionRefusal> result = RefuseAction("acsd is stopping.");
    Call([&](Core::Now now, Planning::AdapterActions& out) {
        result = actionsOrNull->Request(request, now, out);
        if (result.has_value())
        {
            PublishAction(_history.Add(
                {*result,
                 std::move(request.actionType),
                 std::move(request.parameters),
                 std::move(reason),
                 now.wall,
                 ERobotActionStatus::Waiting,
                 {},
                 std::nullopt}));
        }
    });
    return result;
}

const std::vector<RobotActionRecord>& RobotRunner::GetActions() const noexcept
{
    return _history.GetRecords();
}

std::vector<RobotActionOffer> RobotRunner::ListActionOffers() const
{
    const IRobotActions* const actionsOrNull = _bStopped ? nullptr : _robot->GetActionsOrNull();
    return actionsOrNull == nullptr ? std::vector<RobotActionOffer>() : actionsOrNull->ListOffers();
}

RobotServices RobotRunner::MakeServices()
{
    return {
        _dependencies.executor,
        _dependencies.clock,
        _dependencies.random,
        _dependencies.logger.MakeFor("robot." + _robotID),
        _metrics,
        [this](const RobotServices::AdapterCall& adapterCall) { Call(adapterCall); },
        [this](ETraceDirection direction, std::string_view text) { Trace(direction, text); },
        _openStream,
        _mqtt.get(),
        [this] {
            return !_dependencies.mayCommand || _dependencies.mayCommand();
        }};
}

template <typename TCall>
void RobotRunner::Call(const TCall& adapterCall)
{
    if (_bStopped)
    {
        return;
    }
    Planning::AdapterActions wanted;
    CallAdapter(adapterCall, wanted);
    std::ranges::move(wanted, std::back_inserter(_actions));
    if (std::exchange(_bExecuting, true))
    {
        return;
    }
    while (!_actions.empty())
    {
        const Planning::AdapterAction action = std::move(_actions.front());
        _actions.pop_front();
        Execute(action);
    }
    _bExecuting = false;
    _robot->OnAdapterCalled();
    UpdateHistory();
}

void RobotRunner::UpdateHistory()
{
    IRobotActions* const actionsOrNull = _robot->GetActionsOrNull();
    if (actionsOrNull == nullptr)
    {
        return;
    }
    for (const RobotActionChange& change : actionsOrNull->TakeChanges())
    {
        const RobotActionRecord* const recordOrNull = _history.ApplyOrNull(change, _dependencies.clock.GetNow().wall);
        if (recordOrNull != nullptr && IsEnded(recordOrNull->status))
        {
            PublishAction(*recordOrNull);
        }
    }
}

void RobotRunner::PublishAction(const RobotActionRecord& record) const
{
    if (_dependencies.onAction)
    {
        _dependencies.onAction(_robotID, record);
    }
}

/// An exception ends acsd: whose it is helps the author of the driver.
template <typename TCall>
void RobotRunner::CallAdapter(const TCall& adapterCall, Planning::AdapterActions& out) const
{
    try
    {
        adapterCall(_dependencies.clock.GetNow(), out);
    }
    catch (const std::exception& error)
    {
        throw std::runtime_error(
            fmt::format("the adapter of the robot {} (driver {}) has thrown: {}", _robotID, _driver, error.what()));
    }
}

void RobotRunner::Execute(const Planning::AdapterAction& action)
{
    std::visit(
        Core::Overloaded{
            [this](const Planning::RaiseEvent& raise) {
                LogDefects(raise.event);
                _handler(_robotID, raise.event);
            },
            [this](const Planning::StartAdapterTimer& start) { _timers.Start(start.timer, start.delay); },
            [this](const Planning::CancelAdapterTimer& cancel) {
                _timers.Cancel(cancel.timer);
            }},
        action);
}

void RobotRunner::LogDefects(const Planning::RobotEvent& event)
{
    const auto* const stateOrNull = std::get_if<Planning::StateChanged>(&event);
    if (stateOrNull == nullptr)
    {
        return;
    }
    for (const StateDefect& defect : FindStateDefects(*stateOrNull, _ports))
    {
        _ignored.Write(
            _dependencies.clock.GetNow().steady,
            Core::ELogLevel::Warning,
            defect.kind,
            "a value of the robot's state is ignored",
            {{"robotId", _robotID}, {"driver", _driver}, {"reason", defect.reason}});
    }
}

void RobotRunner::Trace(ETraceDirection direction, std::string_view text) const
{
    if (_dependencies.traceOrNull != nullptr)
    {
        const auto wire =
            direction == ETraceDirection::In ? ProtocolBeast::EWireDirection::In : ProtocolBeast::EWireDirection::Out;
        _dependencies.traceOrNull->Write({_driver, wire, _robotID, {}, text});
    }
}

} // namespace ACS::Acsd
