#pragma once

#include "common/faults/FaultGrammar.hpp"
#include "robots/RobotAdapterFactory.hpp"
#include "SeededRandom.hpp"
#include "vda-sim/VirtualVehicle.hpp"
#include <acs/adapter_test/IAdapterBench.hpp>
#include <acs/core/Overloaded.hpp>
#include <acs/vda5050/Topic.hpp>

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace ACS::Testing
{

/// The vehicle of vda-sim with acsd's adapter, joined by a broker that retains messages.
class VehicleBench final : public AdapterTest::IAdapterBench
{
public:
    /// Whose connection to the broker is the link.
    enum class ELink : std::uint8_t
    {
        OfAdapter,
        OfVehicle,
    };

private:
    static constexpr std::chrono::milliseconds LATENCY{10};
    /// After which the broker publishes the will of the vehicle.
    static constexpr std::chrono::milliseconds KEEP_ALIVE{3'000};
    static constexpr const char* ROBOT = "LR01";

    const ELink _link;
    const Planning::SiteMap _site = MakeSite();
    AdapterTest::IVirtualTime* _timeOrNull = nullptr;
    AdapterTest::IAdapterHost* _hostOrNull = nullptr;
    bool _bRepeats = false;
    // The broker.
    std::map<std::string, VDA5050::MqttMessage> _retained;
    bool _bAdapterUp = false;
    bool _bVehicleUp = false;
    std::size_t _adapterConnection = 0; ///< What is in transit over an earlier one is lost.
    std::size_t _vehicleConnection = 0;
    bool _bLinkUp = true;
    // The adapter.
    Acsd::RobotOutputs _outputs;
    Acsd::RobotAdapter _adapter;
    // The vehicle.
    std::unique_ptr<SeededRandom> _random;
    std::unique_ptr<VdaSim::VirtualVehicle> _vehicle;
    VdaSim::VirtualActions _actions;
    std::map<std::uint64_t, std::size_t> _timers; ///< The number of the last start, by key.
    std::size_t _lastTimer = 0;
    std::map<std::string, VDA5050::EActionStatus> _status; ///< Of its jobs, by commandID.
    AdapterTest::RobotTruth _truth;

public:
    explicit VehicleBench(ELink link)
        : _link(link)
    {
    }

    [[nodiscard]] AdapterTest::BenchOptions GetOptions() const override;
    [[nodiscard]] Planning::StartJob MakeJob(std::size_t number) const override;
    void MakeRobot(AdapterTest::IVirtualTime& time) override;
    [[nodiscard]] Planning::IRobotAdapter& MakeAdapter(AdapterTest::IAdapterHost& host) override;
    void DestroyAdapter() override;
    void DestroyRobot() override;
    void OnAdapterCalled() override;
    void SetLink(bool bUp) override;
    void SetConduct(AdapterTest::EConduct conduct) override;
    [[nodiscard]] AdapterTest::RobotTruth GetTruth() const override;

private:
    [[nodiscard]] static Planning::SiteMap MakeSite();
    [[nodiscard]] static Acsd::VehicleConfig MakeVehicleConfig();

    void Post(std::size_t& connection, std::function<void()> task);
    void ConnectAdapterSoon();
    void ConnectVehicleSoon();
    void PublishToAdapter(const VDA5050::MqttMessage& message);
    void DeliverToAdapter(const VDA5050::MqttMessage& message);
    template <typename TCall>
    void CallVehicle(TCall call);
    void Execute(const VdaSim::VirtualAction& action);
    void Inject(std::string_view text);
    void UpdateTruth();
};

} // namespace ACS::Testing
