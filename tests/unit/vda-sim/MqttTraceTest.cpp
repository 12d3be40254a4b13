#include "vda-sim/MqttTrace.hpp"

#include "Catch.hpp"
#include "FolderLines.hpp"
#include "ManualClock.hpp"
#include "TemporaryFolder.hpp"

#include <memory>
#include <string>
#include <system_error>
#include <utility>
#include <vector>

namespace ACS::Testing
{

namespace
{

/// Accepts or refuses messages; each takes 5 ms.
class SlowLink final : public VDA5050::IMqttLink
{
    ManualClock& _clock;

public:
    bool bFails = false;

    explicit SlowLink(ManualClock& clock)
        : _clock(clock)
    {
    }

    [[nodiscard]] Core::Result<void> Publish(const VDA5050::MqttMessage& /*message*/) override
    {
        _clock.Advance(std::chrono::milliseconds(5));
        return bFails ? Core::Result<void>(Core::Fail(std::make_error_code(std::errc::not_connected)))
                      : Core::Result<void>();
    }

    void Subscribe(const std::vector<VDA5050::MqttSubscription>& /*subscriptions*/) override
    {
    }

    void Unsubscribe(const std::string& /*topicFilter*/) override
    {
    }
};

} // namespace

TEST_CASE("The trace of a vehicle has what it receives, and what the link accepts with the time before it is sent")
{
    const TemporaryFolder folder;
    ManualClock clock;
    SlowLink link(clock);
    {
        auto trace = Apps::SimulatorTrace::Create("vda-sim", {folder.GetPath().string(), {}}, clock, Core::Logger());
        REQUIRE(trace.has_value());
        const VdaSim::MqttTrace vehicle(trace->get(), "LR01");
        vehicle.OnReceived({"uagv/v2/ACS/LR01/order", R"({"orderId":"O"})", 0, false});
        CHECK(vehicle.Publish({"uagv/v2/ACS/LR01/state", "{}", 0, false}, link).has_value());
        link.bFails = true;
        CHECK_FALSE(vehicle.Publish({"uagv/v2/ACS/LR01/state", "lost", 0, false}, link).has_value());
        VdaSim::MqttTrace(trace->get(), {}).OnSent({"vda-sim/control/result", "ok", 1, false});
    }
    CHECK(
        ReadLines(folder.GetPath())
        == std::vector<std::string>{
            R"({"time":"2025-07-02T12:00:00.000Z","mono_us":1000000000,"program":"vda-sim","link":"mqtt","direction":"in","robot":"LR01","topic":"uagv/v2/ACS/LR01/order","text":"{\"orderId\":\"O\"}"})",
            R"({"time":"2025-07-02T12:00:00.000Z","mono_us":1000000000,"program":"vda-sim","link":"mqtt","direction":"out","robot":"LR01","topic":"uagv/v2/ACS/LR01/state","text":"{}"})",
            R"({"time":"2025-07-02T12:00:00.010Z","mono_us":1000010000,"program":"vda-sim","link":"mqtt","direction":"out","topic":"vda-sim/control/result","text":"ok"})"});
}

TEST_CASE("Without a trace a message is published as well")
{
    ManualClock clock;
    SlowLink link(clock);
    const VdaSim::MqttTrace vehicle(nullptr, "LR01");
    vehicle.OnReceived({"t", "{}", 0, false});
    vehicle.OnSent({"t", "{}", 0, false});
    CHECK(vehicle.Publish({"t", "{}", 0, false}, link).has_value());
    link.bFails = true;
    CHECK_FALSE(vehicle.Publish({"t", "{}", 0, false}, link).has_value());
}

} // namespace ACS::Testing
