#pragma once

#include <acs/core/Location.hpp>
#include <acs/plan/IPlanStore.hpp>
#include <acs/plan/RobotEvent.hpp>

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace ACS::Planning
{

/// The id on record of a carrier whose id is unknown.
inline constexpr std::string_view UNKNOWN_CARRIER = "UNKNOWN";

/// One entry per carrier port; nullopt: the port is empty.
using CarrierIDs = std::vector<std::optional<std::string>>;

/// A port that a job empties or fills.
struct PortUse
{
    std::size_t port = 0;
    bool bFills = false;
};

/// The record of a robot's carrier ports: what jobs moved, operators corrected and the robot's sensors report. A port where a
/// report contradicts the record is disputed until the report agrees again, a job moves its carrier or an operator decides.
class PortLedger
{
public:
    /// By port: whether the jobs of a plan so far have filled it, or emptied it.
    using Contents = std::map<std::size_t, bool>;

    struct Comparison
    {
        bool bRecordChanged = false;
        bool bDisputed = false; ///< A port is disputed, or was before.
    };

private:
    struct Dispute
    {
        std::optional<std::string> expected;
        std::string reported;
    };

    std::span<const Core::Location> _ports;
    CarrierIDs _carriers;
    /// By name: on record at ports that no longer exist, until an operator has corrected the record or the port is back.
    std::map<std::string, std::string> _stranded;
    std::map<std::size_t, Dispute> _disputes;
    bool _bReportLimited = false;

public:
    PortLedger() = default;
    /// The ports must outlive the ledger. All are empty.
    explicit PortLedger(std::span<const Core::Location> ports);

    /// After a restart, by the names of the ports; a record without names counts if it has as many ports as there are. Carriers
    /// whose ports no longer exist may be at a port that the record does not have: such ports then have an unknown carrier until
    /// an operator or the robot's sensors correct the record.
    void Restore(const CarriersChanged& record);
    /// By an operator: one entry per port.
    void Correct(CarrierIDs carriers);
    void ForgetDisputes();
    /// The robot's sensors replace the record, except at the ports of an unfinished job. A carrier that is reported at two ports
    /// changes no ID.
    [[nodiscard]] Comparison Compare(std::span<const PortLoad> loads, std::span<const PortUse> openUses);
    /// Records what a finished job moved. Returns the contradiction with the record, if any; the job counts in any case, because
    /// the record was wrong then.
    [[nodiscard]] std::string Move(std::span<const PortUse> uses, const std::optional<std::string>& carrierIDOrNull);

    /// Whether disputes may be reported now: once per interval, which the caller times.
    [[nodiscard]] bool TryBeginReportInterval();
    void EndReportInterval();

    [[nodiscard]] const CarrierIDs& GetCarriers() const noexcept;
    /// The carriers on record at ports that no longer exist ("C1 (CR01.TP03), C2 (CR01.TP04)"); empty if there are none.
    [[nodiscard]] std::string DescribeStranded() const;
    /// What is stored: the ports, then those that no longer exist and had a carrier.
    [[nodiscard]] CarriersChanged MakeRecord(const std::string& robotID) const;
    [[nodiscard]] bool IsDisputed() const noexcept;
    /// "LR01.CP01: expected C1, reported no carrier; …"
    [[nodiscard]] std::string DescribeDisputes() const;
    [[nodiscard]] const std::string& GetName(std::size_t port) const;
    [[nodiscard]] std::optional<std::size_t> FindPortOrNull(std::string_view name) const;
    [[nodiscard]] std::optional<std::size_t> FindCarrierOrNull(const std::string& carrierID) const;
    /// For a memory place in a tray on the robot: the port of that tray, if the tray is neither on record nor loaded by an
    /// earlier job.
    [[nodiscard]] std::optional<std::size_t> FindMissingTrayOrNull(const Core::Location& place, const Contents& planned)
        const;

private:
    void CompareLoad(std::size_t port, const PortLoad& load, const std::string& otherPorts);
    [[nodiscard]] std::string DescribeContradiction(
        const PortUse& use,
        const std::optional<std::string>& carrierIDOrNull) const;
};

} // namespace ACS::Planning
