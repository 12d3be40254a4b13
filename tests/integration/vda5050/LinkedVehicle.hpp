#pragma once

#include "Catch.hpp"
#include "LinkFixture.hpp"
#include "SchemaCheck.hpp"
#include "SessionTimers.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/PredefinedActions.hpp>
#include <acs/vda5050/VehicleSession.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>
#include <boost/asio/post.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <tuple>
#include <utility>
#include <variant>
#include <vector>

namespace ACS::Testing
{

/// A VehicleSession on a link, with a vehicle that drives to each node at once, unless it is held.
class LinkedVehicle final : VDA5050::IMqttLinkListener
{
public:
    static constexpr std::uint32_t EVERYWHERE = 1'000;

private:
    boost::asio::io_context& _context;
    RecordingLogSink _log;
    SeededRandom _random;
    SessionTimers<VDA5050::EVehicleTimer> _timers;
    VDA5050::VehicleSession _session;
    VDA5050::MosquittoLink _link;
    std::optional<VDA5050::DriveTo> _goal;
    std::uint32_t _mayReach = 0;
    bool _bDriveDue = false;
    std::shared_ptr<bool> _alive = std::make_shared<bool>(true); ///< What was posted looks for it first.

public:
    ///< No test's order goes that far.

    VDA5050::VehicleActions events;

    LinkedVehicle(
        boost::asio::io_context& context,
        VDA5050::MosquittoOptions link,
        const VDA5050::VehicleOptions& options)
        : _context(context),
          _timers(context),
          _session(options),
          _link(context.get_executor(), _random, Core::Logger(_log, "mqtt"), WithWill(std::move(link), _session), *this)
    {
        VDA5050::AgvPosition position;
        position.bPositionInitialized = true;
        position.mapID = "floor";
        _session.OnPosition(position, VDA5050::Velocity{});
        _link.Subscribe(_session.GetSubscriptions());
        _link.Start();
    }

    [[nodiscard]] static VDA5050::VehicleOptions MakeOptions(VDA5050::EVda5050Version version)
    {
        VDA5050::VehicleOptions options;
        options.address = VDA5050::Test::MakeAddress();
        options.initialNodeID = "N0";
        options.version = version;
        options.minimumStateInterval = std::chrono::milliseconds(5);
        options.factsheet.protocolFeatures.agvActions = VDA5050::GetPredefinedActions();
        return options;
    }

    /// It stops at this node.
    void LetReach(std::uint32_t sequenceID)
    {
        _mayReach = sequenceID;
        PostDrive();
    }

    [[nodiscard]] const VDA5050::VehicleSession& GetSession() const
    {
        return _session;
    }

    template <typename TEvent>
    [[nodiscard]] std::size_t Count() const
    {
        return VDA5050::Test::Pick<TEvent>(events).size();
    }

    [[nodiscard]] std::size_t CountStarts(const std::string& actionID) const
    {
        const auto starts = VDA5050::Test::Pick<VDA5050::StartAction>(events);
        return static_cast<std::size_t>(std::ranges::count_if(starts, [&actionID](const VDA5050::StartAction& start) {
            return start.action.actionID == actionID;
        }));
    }

private:
    [[nodiscard]] static VDA5050::MosquittoOptions WithWill(
        VDA5050::MosquittoOptions options,
        VDA5050::VehicleSession& session)
    {
        options.will = session.MakeWill(ReadClock());
        CheckValid(options.will->message.topic, options.will->message.payload);
        return options;
    }

    template <typename TCall>
    void Do(const TCall& call)
    {
        VDA5050::VehicleActions out;
        call(_session, ReadClock(), out);
        Execute(out);
    }

    void Post(std::function<void()> call)
    {
        boost::asio::post(_context, [alive = std::weak_ptr(_alive), call = std::move(call)]() {
            if (!alive.expired())
            {
                call();
            }
        });
    }

    void PostDrive()
    {
        if (_bDriveDue)
        {
            return;
        }
        _bDriveDue = true;
        Post([this]() {
            _bDriveDue = false;
            if (!_goal.has_value() || _goal->node.sequenceID > _mayReach)
            {
                return;
            }
            const VDA5050::DriveTo goal = *std::exchange(_goal, std::nullopt);
            VDA5050::AgvPosition position;
            position.bPositionInitialized = true;
            position.mapID = "floor";
            position.x = goal.node.nodePosition->x;
            _session.OnPosition(position, VDA5050::Velocity{});
            Do([&goal](auto& vehicle, Core::Now now, auto& out) {
                vehicle.OnDrivingChanged(true, now, out);
                CHECK(vehicle.TryReachNode({goal.node.sequenceID, goal.bStopAtNode}, now, out));
            });
            Do([](auto& vehicle, Core::Now now, auto& out) { vehicle.OnDrivingChanged(false, now, out); });
        });
    }

    void Perform(const VDA5050::Action& action)
    {
        Post([this, action]() {
            const auto set = [this, &action](VDA5050::EActionStatus status) {
                Do([&](auto& vehicle, Core::Now now, auto& out) {
                    CHECK(vehicle.TrySetActionStatus(action.actionID, status, {}, now, out));
                });
            };
            set(VDA5050::EActionStatus::Running);
            set(VDA5050::EActionStatus::Finished);
        });
    }

    void Execute(const VDA5050::VehicleActions& actions)
    {
        for (const VDA5050::VehicleAction& action : actions)
        {
            events.push_back(action);
            ExecuteOne(action);
        }
    }

    void ExecuteOne(const VDA5050::VehicleAction& action)
    {
        if (const auto* publish = std::get_if<VDA5050::PublishMessage>(&action))
        {
            CheckValid(publish->message.topic, publish->message.payload);
            std::ignore = _link.Publish(publish->message);
        }
        else if (const auto* start = std::get_if<VDA5050::StartVehicleTimer>(&action))
        {
            const VDA5050::EVehicleTimer timer = start->timer;
            _timers.Start(timer, start->delay, [this, timer]() {
                Do([timer](auto& vehicle, Core::Now now, auto& out) { vehicle.OnTimer(timer, now, out); });
            });
        }
        else if (const auto* cancel = std::get_if<VDA5050::CancelVehicleTimer>(&action))
        {
            _timers.Cancel(cancel->timer);
        }
        else if (const auto* drive = std::get_if<VDA5050::DriveTo>(&action))
        {
            _goal = *drive;
            PostDrive();
        }
        else if (std::holds_alternative<VDA5050::StopDriving>(action))
        {
            _goal.reset();
            Post([this]() {
                Do([](auto& vehicle, Core::Now now, auto& out) { vehicle.OnDrivingChanged(false, now, out); });
            });
        }
        else if (const auto* perform = std::get_if<VDA5050::StartAction>(&action))
        {
            Perform(perform->action);
        }
    }

    void OnLinkUp() override
    {
        Do([](auto& vehicle, Core::Now now, auto& out) { vehicle.OnLinkUp(now, out); });
    }

    void OnLinkDown(std::error_code /*reason*/) override
    {
        Do([](auto& vehicle, Core::Now now, auto& out) { vehicle.OnLinkDown(now, out); });
    }

    void OnMqttMessage(const VDA5050::MqttMessage& message) override
    {
        Do([&message](auto& vehicle, Core::Now now, auto& out) {
            vehicle.OnMessage(message.topic, message.payload, message.bRetained, now, out);
        });
    }
};

} // namespace ACS::Testing
