#pragma once

#include "ManualClock.hpp"
#include "Vda5050Sample.hpp"
#include <acs/vda5050/VehicleSession.hpp>

#include <chrono>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::VDA5050::Test
{

/// A vehicle at N0 with a link. It records the actions of the session and never drives by itself.
class VehicleSessionFixture
{
    Testing::ManualClock _clock;
    VehicleSession _session;
    VehicleActions _out;
    std::uint32_t _headerID = 0;

public:
    explicit VehicleSessionFixture(VehicleOptions options = MakeOptions());
    VehicleSessionFixture(const VehicleSessionFixture&) = delete;
    VehicleSessionFixture& operator=(const VehicleSessionFixture&) = delete;
    VehicleSessionFixture(VehicleSessionFixture&&) = delete;
    VehicleSessionFixture& operator=(VehicleSessionFixture&&) = delete;
    ~VehicleSessionFixture(); ///< As Clear: what was published is checked against the schemas.

    [[nodiscard]] static VehicleOptions MakeOptions();
    /// With every action of the standard.
    [[nodiscard]] static VehicleOptions MakeOptionsOfStandard();

    [[nodiscard]] VehicleSession& GetSession();
    [[nodiscard]] Core::Now GetNow() const;
    [[nodiscard]] const VehicleActions& GetOutput() const;
    void Clear();
    void Advance(std::chrono::milliseconds span);

    void Order(OrderMessage order);
    void Payload(ETopic topic, std::string_view payload, bool bRetained = false);
    void Instant(
        std::string_view actionType,
        const std::string& actionID,
        std::vector<ActionParameter> parameters = {});
    void Instant(std::vector<Action> actions);
    void Reach(std::uint32_t sequenceID, bool bStationary = false, std::vector<EdgeActionEnd> edgeActions = {});
    void Drive(bool bDriving);
    void Status(std::string_view actionID, EActionStatus status);
    void StandAt(double x, double theta = 0.0);
    void Mode(EOperatingMode mode);
    void HardwarePause(bool bPaused, bool bOverridesMaster);

    /// The last state that was published, or the present one where none was.
    [[nodiscard]] StateMessage GetPublishedState() const;
    [[nodiscard]] std::vector<StateMessage> GetPublishedStates() const;
    [[nodiscard]] std::vector<std::string> GetStartedActions() const;
    [[nodiscard]] EActionStatus GetStatus(std::string_view actionID) const;
    [[nodiscard]] bool HasError(std::string_view errorType) const;
};

} // namespace ACS::VDA5050::Test
