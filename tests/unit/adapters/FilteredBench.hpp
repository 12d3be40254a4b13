#pragma once

#include <acs/adapter_test/IAdapterBench.hpp>

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Testing
{

/// A bench whose adapter has a defect: each of its events is changed.
class FilteredBench final : public AdapterTest::IAdapterBench
{
public:
    using Change = std::function<Planning::RobotEvent(const Planning::RobotEvent& event)>;

private:
    /// Changes what the adapter appends, in its own calls and in those of its host.
    class Filter final : public Planning::IRobotAdapter, public AdapterTest::IAdapterHost
    {
        const Change _change;
        AdapterTest::IAdapterHost& _host;
        Planning::IRobotAdapter* _adapterOrNull = nullptr;

    public:
        Filter(Change change, AdapterTest::IAdapterHost& host)
            : _change(std::move(change)),
              _host(host)
        {
        }

        void SetAdapter(Planning::IRobotAdapter& adapter)
        {
            _adapterOrNull = &adapter;
        }

        void Handle(const Planning::RobotCommand& command, Core::Now now, Planning::AdapterActions& out) override
        {
            _adapterOrNull->Handle(command, now, out);
            ChangeAll(out);
        }

        void OnTimer(Planning::AdapterTimerID timer, Core::Now now, Planning::AdapterActions& out) override
        {
            _adapterOrNull->OnTimer(timer, now, out);
            ChangeAll(out);
        }

        [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view action) const override
        {
            return _adapterOrNull->GetRejectionReasonOrNull(action);
        }

        void Call(const AdapterCall& adapterCall) override
        {
            _host.Call([this, &adapterCall](Core::Now now, Planning::AdapterActions& out) {
                adapterCall(now, out);
                ChangeAll(out);
            });
        }

    private:
        void ChangeAll(Planning::AdapterActions& out) const
        {
            for (Planning::AdapterAction& action : out)
            {
                if (auto* const raiseOrNull = std::get_if<Planning::RaiseEvent>(&action))
                {
                    raiseOrNull->event = _change(raiseOrNull->event);
                }
            }
        }
    };

    AdapterTest::IAdapterBench& _bench;
    const Change _change;
    std::unique_ptr<Filter> _filter;

public:
    FilteredBench(AdapterTest::IAdapterBench& bench, Change change)
        : _bench(bench),
          _change(std::move(change))
    {
    }

    [[nodiscard]] AdapterTest::BenchOptions GetOptions() const override
    {
        return _bench.GetOptions();
    }

    [[nodiscard]] Planning::StartJob MakeJob(std::size_t number) const override
    {
        return _bench.MakeJob(number);
    }

    void MakeRobot(AdapterTest::IVirtualTime& time) override
    {
        _bench.MakeRobot(time);
    }

    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override
    {
        _filter = std::make_unique<Filter>(_change, host);
        _filter->SetAdapter(_bench.MakeAdapter(*_filter));
        return *_filter;
    }

    void DestroyAdapter() override
    {
        _bench.DestroyAdapter();
    }

    void DestroyRobot() override
    {
        _bench.DestroyRobot();
        _filter.reset();
    }

    void OnAdapterCalled() override
    {
        _bench.OnAdapterCalled();
    }

    void SetLink(bool bUp) override
    {
        _bench.SetLink(bUp);
    }

    void SetConduct(AdapterTest::EConduct conduct) override
    {
        _bench.SetConduct(conduct);
    }

    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const override
    {
        return _bench.GetTruth();
    }
};

} // namespace ACS::Testing
