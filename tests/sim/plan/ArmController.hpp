#pragma once

#include "ArmConnection.hpp"
#include "ChanceModel.hpp"
#include "EMutation.hpp"
#include "openstream-sim/api/FaultyService.hpp"
#include "openstream-sim/controller/ControllerFaults.hpp"
#include "openstream-sim/controller/IFaultHost.hpp"
#include "openstream-sim/controller/VirtualController.hpp"
#include "TextNetwork.hpp"
#include "TimerBank.hpp"
#include "Trace.hpp"
#include "WorkChecker.hpp"

#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>

namespace ACS::Simulation
{

/// The controller of an arm: that of openstream-sim with its sessions and its own network. The checks use its counters.
/// Each start of a program is identified by the job for which acsd sent it.
class ArmController final : private ITextPeer, private OpenStreamSim::IFaultHost
{
public:
    /// What it needs from outside; everything outlives it.
    struct Dependencies
    {
        Timeline& timeline;
        Trace& trace;
        WorkChecker& workChecker;
        EMutation mutation;
        bool bBadRadio; ///< Connections break when a message can be lost.
    };

    struct Seeds
    {
        ChanceSeed controller;
        ChanceSeed network;
    };

private:
    /// What is lost with the memory.
    struct Machine
    {
        OpenStreamSim::VirtualController controller;
        OpenStreamSim::ControllerFaults faults;
        OpenStreamSim::FaultyService service;

        Machine(const OpenStreamSim::ControllerOptions& options, OpenStreamSim::IFaultHost& host, Core::Now now);
    };

    struct Counters
    {
        std::int32_t started = 0;
        std::int32_t finished = 0;
        std::int32_t failed = 0;
    };

    enum class EBehaviour : std::uint8_t
    {
        Wake, ///< Of faults.
        Poll, ///< Polls a running program.
        Power,
        Hand,
    };

    Dependencies _around;
    ChanceModel _chance;
    ChanceModel _clientRandom;
    TextNetwork _network;
    std::string _robotID;
    bool _bFaulty;
    std::function<bool()> _isDriving;
    std::unique_ptr<Machine> _machine;
    std::map<Protocol::ConnectionID, std::unique_ptr<ArmConnection>> _connections;
    TimerBank<EBehaviour> _behaviours;
    std::map<Protocol::ConnectionID, std::deque<std::string>> _starts; ///< CommandIDs, by connection.
    Core::SteadyTime _lastStartAt{};                                   ///< When the last one was sent.
    Counters _seen;
    std::string _running; ///< The command of the program that runs or was stopped; empty: none.
    bool _bStopAsked = false;
    bool _bHaltedByFault = false;
    bool _bReachable = true;
    bool _bPowered = true;
    bool _bCalm = false;

public:
    /// IsDriving returns whether the base of the arm moves.
    ArmController(
        const Dependencies& around,
        const Seeds& seeds,
        std::string robotID,
        bool bFaulty,
        std::function<bool()> isDriving);
    ArmController(const ArmController&) = delete;
    ArmController& operator=(const ArmController&) = delete;
    ~ArmController() override;

    [[nodiscard]] TextNetwork& GetNetwork() noexcept;
    /// For the sessions of acsd.
    [[nodiscard]] Core::IRandom& GetClientRandom() noexcept;

    /// Whether acsd's client has this defect.
    [[nodiscard]] bool Is(EMutation mutation) const noexcept;

    /// acsd sends the start of a program on this connection, for this command.
    void NoteStartSent(Protocol::ConnectionID connection, const std::string& commandID);

    /// Adds what acsd receives to the trace.
    void AddToTrace(const std::string& text) const;

    void SetReachable(bool bReachable);
    /// Begins a random fault of the controller or its clients, until it recovers.
    void Disturb();
    void Recover();
    /// A power loss for a while, with or without the memory.
    void Restart();
    void Calm();

    [[nodiscard]] bool IsPlaying();
    /// A program runs or was halted by a fault, or its start may be in transit: its outcome is still open.
    [[nodiscard]] bool IsWorkUnderWay();

private:
    void SwitchOn();
    void UpdateNetwork();
    [[nodiscard]] OpenStreamSim::ControllerMachine& GetMachine();
    [[nodiscard]] Counters ReadCounters();
    void Poll(const std::string& startedFor);
    void WatchProgram();
    void Call(
        Protocol::ConnectionID connection,
        const OpenStream::ApiRequest& request,
        OpenStream::ApiResponse& response);
    [[nodiscard]] std::string TakeStart(Protocol::ConnectionID connection);
    void CheckProgram(const Planning::StartJob& job);
    void Inject(const OpenStreamSim::Fault& fault);
    void SetRight();
    void RunByHand();
    void DropSessions() override;
    void WakeAt(std::optional<Core::SteadyTime> timeOrNull) override;
    void OnOpened(Protocol::ConnectionID connection) override;
    void OnText(Protocol::ConnectionID connection, const std::string& text) override;
    void OnClosed(Protocol::ConnectionID connection, const std::string& reason) override;
};

} // namespace ACS::Simulation
