#pragma once

#include <acs/core/Location.hpp>
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
    std::map<std::size_t, Dispute> _disputes;
    bool _bReportLimited = false;

public:
    PortLedger() = default;
    /// The ports must outlive the ledger. All are empty.
    explicit PortLedger(std::span<const Core::Location> ports);

    /// After a restart. Ignored where the number of ports is another one.
    void Restore(const CarrierIDs& carriers);
    /// By an operator: one entry per port.
    void Correct(CarrierIDs carriers);
    void ForgetDisputes();
    /// The robot's sensors replace the record, but not at the ports of a job that has not ended: what is reported there
    /// meanwhile is no evidence. A carrier that is reported at two ports changes no id.
    [[nodiscard]] Comparison Compare(std::span<const PortLoad> loads, std::span<const PortUse> openUses);
    /// Enters what a finished job moved. Returns why that contradicts the record; empty where it does not. The job counts in
    /// any case: the record was wrong then.
    [[nodiscard]] std::string Move(std::span<const PortUse> uses, const std::optional<std::string>& carrierID);

    /// Whether disputes may be reported now: once in an interval, which the caller times.
    [[nodiscard]] bool TryBeginReportInterval();
    void EndReportInterval();

    [[nodiscard]] const CarrierIDs& GetCarriers() const noexcept;
    [[nodiscard]] bool IsDisputed() const noexcept;
    /// "LR01.CP01: expected C1, shown no carrier; …"
    [[nodiscard]] std::string DescribeDisputes() const;
    [[nodiscard]] const std::string& GetName(std::size_t port) const;
    [[nodiscard]] std::optional<std::size_t> FindPortOrNull(std::string_view name) const;
    [[nodiscard]] std::optional<std::size_t> FindCarrierOrNull(const std::string& carrierID) const;
    /// The port of the tray that a memory place of a robot is inside of, where that tray is neither on record nor planned to
    /// be loaded before.
    [[nodiscard]] std::optional<std::size_t> FindMissingTrayOrNull(const Core::Location& place, const Contents& planned)
        const;

private:
    void CompareLoad(std::size_t port, const PortLoad& load, const std::string& otherPorts);
    [[nodiscard]] std::string DescribeContradiction(const PortUse& use, const std::optional<std::string>& carrierID)
        const;
};

} // namespace ACS::Planning
