#pragma once

#include "common/process/SystemClock.hpp"
#include "common/process/SystemRandom.hpp"
#include "common/process/TimerSet.hpp"
#include <acs/vda5050/MasterFleet.hpp>
#include <acs/vda5050/OrderBuilder.hpp>
#include <acs/vda5050_mosquitto/MosquittoLink.hpp>

#include <boost/asio/io_context.hpp>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Load
{

/// Messages of one vehicle on a topic.
struct TopicCount
{
    std::uint64_t messages = 0;
    std::uint64_t missing = 0; ///< By the gaps in their headerIds.
    std::optional<std::uint32_t> lastHeaderID;
    std::optional<Core::SteadyTime> lastTime;
    Core::Duration longestPause{};
};

struct VehicleCount
{
    TopicCount states;
    TopicCount visualizations;
};

/// Counts of the master's messages and errors.
struct MasterCount
{
    std::uint64_t ordersSent = 0;
    std::uint64_t updatesSent = 0;
    std::uint64_t nodesReached = 0;
    std::uint64_t errors = 0;
    std::string firstError;
};

/// Master control of a fleet on the ring: discovers the vehicles and sends each a long order, whose base it extends while the
/// vehicle drives, then the next order.
class FleetMaster final : public VDA5050::IMqttLinkListener
{
    /// The order of one vehicle.
    struct Job
    {
        std::optional<VDA5050::OrderBuilder> route;
        std::size_t reachedNodes = 0;
        std::size_t orders = 0;
    };

    Apps::SystemClock _clock;
    Apps::SystemRandom _random;
    VDA5050::MasterFleet _fleet;
    VDA5050::FleetActions _actions;
    VDA5050::MosquittoLink _link;
    Apps::TimerSet<std::uint64_t> _timers;
    std::vector<Job> _jobs;
    std::vector<VehicleCount> _counts;
    MasterCount _total;

public:
    FleetMaster(boost::asio::io_context& context, std::uint16_t port);

    void OnLinkUp() override;
    void OnLinkDown(std::error_code reason) override;
    void OnMqttMessage(const VDA5050::MqttMessage& message) override;

    /// Resets the counts.
    void ResetCounts();
    [[nodiscard]] const std::vector<VehicleCount>& GetCounts() const noexcept;
    [[nodiscard]] const MasterCount& GetTotal() const noexcept;
    /// Vehicles that drive according to their last state and have an active order.
    [[nodiscard]] std::size_t CountDriving() const;

private:
    void OnTimer(std::uint64_t key);
    void Execute();
    void Handle(std::size_t vehicle, const VDA5050::MasterAction& action);
    void SendNextOrder(std::size_t vehicle);
    void ReleaseMore(std::size_t vehicle);
    void CountError(std::size_t vehicle, std::string_view what);
};

} // namespace ACS::Load
