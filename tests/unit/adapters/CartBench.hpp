#pragma once

#include "own-driver/CartAdapter.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <functional>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>

namespace ACS::Testing
{

/// The cart of examples/own-driver with its adapter, over one TCP connection at a time. The cart is as cart_sim.py.
class CartBench final : public AdapterTest::IAdapterBench
{
    static constexpr std::chrono::milliseconds LATENCY{20};
    static constexpr std::chrono::milliseconds REPORT_INTERVAL{1'000};
    static constexpr std::chrono::milliseconds STEP_TIME{4'000};
    static constexpr int SLOWNESS = 4;

    AdapterTest::IVirtualTime* _timeOrNull = nullptr;
    AdapterTest::IAdapterHost* _hostOrNull = nullptr;
    std::unique_ptr<CartAdapter> _adapter;
    bool _bLinkUp = true;
    bool _bConnected = false;
    std::size_t _connection = 0; ///< What is left of earlier ones is dropped.
    // The cart.
    std::string _node;
    std::string _next;
    std::string _last;
    std::string _job;
    std::set<std::string> _done;
    bool _bSlow = false;

public:
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
        options.bRefuses = false; // only what it is too busy for
        options.bFails = false;
        options.bRepeats = false; // TCP
        options.bPausesJobs = false;
        options.bCancelsJobs = false;
        options.bCharges = false;
        return options;
    }

    [[nodiscard]] Planning::StartJob MakeJob(std::size_t /*number*/) const override
    {
        Planning::StartJob job;
        job.action = "CassetteLoad";
        job.from = "A01.CP01";
        job.to = "LR01.CP01";
        return job;
    }

    void MakeRobot(AdapterTest::IVirtualTime& time) override
    {
        _timeOrNull = &time;
        _bLinkUp = true;
        _bSlow = false;
        _node = "A";
        _next = "-";
        _last = "-";
        _job.clear();
        _done.clear();
        ReportAtIntervals();
    }

    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override
    {
        _hostOrNull = &host;
        _adapter = std::make_unique<CartAdapter>(CartAdapter::Commands{{"CassetteLoad", "load"}});
        ConnectSoon();
        return *_adapter;
    }

    void DestroyAdapter() override
    {
        _adapter.reset();
        _bConnected = false;
    }

    void DestroyRobot() override
    {
        ++_connection;
    }

    void OnAdapterCalled() override
    {
        for (const std::string& line : _adapter->TakeLines())
        {
            if (_bConnected)
            {
                Post([this, line] { OnLineOfAdapter(line); });
            }
        }
    }

    void SetLink(bool bUp) override
    {
        _bLinkUp = bUp;
        ++_connection;
        if (bUp)
        {
            ConnectSoon();
        }
        else if (std::exchange(_bConnected, false))
        {
            _hostOrNull->Call([this](Core::Now now, auto& out) { _adapter->OnLinkDown(now, out); });
        }
    }

    void SetConduct(AdapterTest::EConduct conduct) override
    {
        _bSlow = conduct == AdapterTest::EConduct::Slow;
    }

    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const override
    {
        return {_node, _next != "-", !_job.empty(), _done.size()};
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

    void ConnectSoon()
    {
        Post([this] {
            if (_adapter == nullptr || !_bLinkUp)
            {
                return;
            }
            ++_connection; // the cart closes the connection before
            _bConnected = true;
            _hostOrNull->Call([this](Core::Now now, auto& out) { _adapter->OnLinkUp(now, out); });
            Report();
        });
    }

    void Send(const std::string& line)
    {
        if (_bConnected)
        {
            Post([this, line] {
                if (_adapter != nullptr)
                {
                    _hostOrNull->Call([this, &line](Core::Now now, auto& out) { _adapter->OnLine(line, now, out); });
                }
            });
        }
    }

    void Report()
    {
        Send("state " + _node + " " + _next + " " + _last);
    }

    void ReportAtIntervals()
    {
        _timeOrNull->Post(REPORT_INTERVAL, [this] {
            Report();
            ReportAtIntervals();
        });
    }

    void Answer(const std::string& job)
    {
        Send("job " + job + " " + (_done.contains(job) ? "done" : job == _job ? "running" : "unknown"));
    }

    void OnLineOfAdapter(const std::string& line)
    {
        std::istringstream words{line};
        std::array<std::string, 3> word;
        words >> word[0] >> word[1] >> word[2];
        if (word[0] == "ask")
        {
            Answer(word[1]);
        }
        else if (word[0] == "go")
        {
            Go(word[1], word[2]);
        }
        else
        {
            Do(word[1]);
        }
    }

    [[nodiscard]] Core::Duration GetStepTime() const
    {
        return _bSlow ? SLOWNESS * STEP_TIME : STEP_TIME;
    }

    void Go(const std::string& drive, const std::string& node)
    {
        if (node == _node || node == _next)
        {
            Report();
        }
        else if (!_job.empty() || _next != "-")
        {
            Send("refused " + drive + " busy");
        }
        else
        {
            _last = drive;
            _next = node;
            Report();
            _timeOrNull->Post(GetStepTime(), [this] {
                _node = std::exchange(_next, "-");
                Report();
            });
        }
    }

    void Do(const std::string& job)
    {
        if (_done.contains(job) || job == _job)
        {
            Send("refused " + job + " known");
        }
        else if (!_job.empty() || _next != "-")
        {
            Send("refused " + job + " busy");
        }
        else
        {
            _last = job;
            _job = job;
            Answer(job);
            _timeOrNull->Post(GetStepTime(), [this] {
                const std::string ended = std::exchange(_job, {});
                _done.insert(ended);
                Answer(ended);
            });
        }
    }
};

} // namespace ACS::Testing
