#pragma once

#include "ReferenceAdapter.hpp"
#include "ReferenceRobot.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>

#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>

namespace ACS::Testing
{

/// The reference robot and its adapter, joined by a link that takes 20 ms for each message.
class ReferenceBench : public AdapterTest::IAdapterBench
{
public:
    using MakeFunction = std::function<std::unique_ptr<ReferenceAdapter>()>;

private:
    static constexpr std::chrono::milliseconds LATENCY{20};

    const MakeFunction _make;
    AdapterTest::IVirtualTime* _timeOrNull = nullptr;
    AdapterTest::IAdapterHost* _hostOrNull = nullptr;
    std::optional<ReferenceRobot> _robot;
    std::unique_ptr<ReferenceAdapter> _adapter;
    bool _bLinkUp = true;
    bool _bConnected = false;    ///< The adapter knows that it is connected.
    std::size_t _connection = 0; ///< The number of the present one: what is left of earlier ones is dropped.
    bool _bRepeats = false;

public:
    explicit ReferenceBench(MakeFunction make)
        : _make(std::move(make))
    {
    }

    [[nodiscard]] AdapterTest::BenchOptions GetOptions() const override
    {
        AdapterTest::BenchOptions options;
        for (const char* nodeID : {"A", "B", "C", "D", "E"})
        {
            options.route.nodes.push_back({nodeID, 0.0, 0.0, std::nullopt, "floor"});
        }
        for (std::size_t i = 0; i + 1 < options.route.nodes.size(); ++i)
        {
            const std::string& from = options.route.nodes[i].nodeID;
            const std::string& to = options.route.nodes[i + 1].nodeID;
            options.route.edges.push_back(
                {from + to, from, to, 1.0, std::nullopt, std::nullopt, std::nullopt, "", std::nullopt});
        }
        options.answerLimit = std::chrono::seconds(30);
        return options;
    }

    [[nodiscard]] Planning::StartJob MakeJob(std::size_t /*number*/) const override
    {
        Planning::StartJob job;
        job.action = "CassetteLoad";
        job.position = "A01.CP01";
        return job;
    }

    void MakeRobot(AdapterTest::IVirtualTime& time) override
    {
        _timeOrNull = &time;
        _bLinkUp = true;
        _bRepeats = false;
        _robot.emplace(time, "A", [this](const ReferenceMessage& message) { SendToAdapter(message); });
    }

    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override
    {
        _hostOrNull = &host;
        _adapter = _make();
        ConnectSoon();
        return *_adapter;
    }

    void DestroyAdapter() override
    {
        _hostOrNull = nullptr;
        _adapter.reset();
        _bConnected = false;
    }

    void DestroyRobot() override
    {
        _robot.reset();
        ++_connection;
    }

    void OnAdapterCalled() override
    {
        for (const ReferenceMessage& message : _adapter->TakeMessages())
        {
            if (_bConnected)
            {
                Post([this, message] { _robot->OnMessage(message); });
            }
        }
    }

    void SetLink(bool bUp) override
    {
        _bLinkUp = bUp;
        ++_connection; // what is in transit is lost
        if (bUp)
        {
            ConnectSoon();
        }
        else if (std::exchange(_bConnected, false))
        {
            _hostOrNull->Call([this](Core::Now /*now*/, auto& out) { _adapter->OnLinkDown(out); });
        }
    }

    void SetConduct(AdapterTest::EConduct conduct) override
    {
        _bRepeats = conduct == AdapterTest::EConduct::Repeats;
        _robot->SetConduct(conduct);
    }

    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const override
    {
        return _robot->GetTruth();
    }

private:
    void Post(std::function<void()> task)
    {
        _timeOrNull->Post(LATENCY, [this, connection = _connection, task = std::move(task)] {
            if (connection == _connection)
            {
                task();
            }
        });
    }

    /// The robot drops what is left of the connection before.
    void ConnectSoon()
    {
        Post([this] {
            if (_adapter == nullptr || !_bLinkUp)
            {
                return;
            }
            ++_connection;
            _bConnected = true;
            _hostOrNull->Call([this](Core::Now /*now*/, auto& out) { _adapter->OnLinkUp(out); });
            _robot->ShowState();
        });
    }

    void SendToAdapter(const ReferenceMessage& message)
    {
        for (int copies = _bConnected ? (_bRepeats ? 2 : 1) : 0; copies > 0; --copies)
        {
            Post([this, message] {
                if (_bConnected)
                {
                    _hostOrNull->Call(
                        [this, &message](Core::Now /*now*/, auto& out) { _adapter->OnMessage(message, out); });
                }
            });
        }
    }
};

} // namespace ACS::Testing
