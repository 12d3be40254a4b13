#pragma once

#include "robots/ArmFixture.hpp"

#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace ACS::Acsd::Test
{

inline const std::string WRITE_NUMBER = R"(CONTROL /project/plc/set_relay_value {"name":"ml105","value":4711})";
inline const std::string WRITE_AREA = R"(CONTROL /project/plc/set_relay_value {"name":"ml106","value":1})";
inline const std::string READ_OUTPUTS = "MONITOR /project/plc/do/val_s32";
/// The number of the job; 0 until it is known.
inline constexpr std::string_view BEFORE = "[5,5,0,0,17]";
inline constexpr std::string_view BEGUN = "[6,5,0,11,4711]";
inline constexpr std::string_view DONE = "[6,6,0,11,4711]";

inline tl::expected<std::vector<ArmInput>, std::string> ResolveInputs(const Planning::StartJob& job)
{
    if (!job.from.has_value())
    {
        return tl::unexpected<std::string>("{from.area}: the job has no from");
    }
    return std::vector<ArmInput>{{*ParseArmRelay("ml105"), job.jobNumber}, {*ParseArmRelay("ml106"), 1}};
}

/// Its programs have inputs and echo the number of their job.
struct ArmInputFixture : ArmFixture
{
    explicit ArmInputFixture(ArmInputResolver inputs = ResolveInputs, ArmOptions options = {})
        : ArmFixture(std::move(options), std::move(inputs))
    {
        BringUp(BEFORE);
    }

    static Planning::StartJob MakeJob(std::int32_t number = 4711)
    {
        Planning::StartJob job;
        job.jobID = "J";
        job.action = "TrayLoad";
        job.from = "A01.CP01.TP01";
        job.progressToken = "5 5 0";
        job.jobNumber = number;
        return job;
    }

    void Command(const Planning::StartJob& job)
    {
        adapter.Handle(job, clock.GetNow(), actions);
    }

    /// The program is selected, and the inputs are written; they are being read.
    void WriteInputs()
    {
        Command(MakeJob());
        CHECK(TakeRequests() == std::vector<std::string>{SELECT});
        Settle(OpenStream::EControlOutcome::Accepted);
        ShowVerification(BEFORE);
        WriteAll();
    }

    /// The program is selected; its first input is being written.
    void SelectWithInputs()
    {
        Command(MakeJob());
        static_cast<void>(TakeRequests());
        Settle(OpenStream::EControlOutcome::Accepted);
        ShowVerification(BEFORE);
    }

    /// All inputs are written; the first range is being read.
    void WriteInputs(int count)
    {
        SelectWithInputs();
        for (int written = 0; written < count; ++written)
        {
            Settle(OpenStream::EControlOutcome::Accepted);
        }
        static_cast<void>(TakeRequests());
        AcknowledgeMonitor();
    }

    void WriteAll()
    {
        CHECK(TakeRequests() == std::vector<std::string>{WRITE_NUMBER});
        Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(TakeRequests() == std::vector<std::string>{WRITE_AREA});
        Settle(OpenStream::EControlOutcome::Accepted);
        CHECK(TakeRequests() == std::vector<std::string>{MONITOR_COUNTERS});
        AcknowledgeMonitor();
    }

    /// The program is started.
    void StartWithInputs()
    {
        WriteInputs();
        DeliverData("[4711,1]");
        ShowVerification(BEFORE);
        CHECK(TakeRequests() == std::vector<std::string>{START});
        Settle(OpenStream::EControlOutcome::Accepted);
        ShowVerification(BEFORE);
    }

    std::string TakeFailure()
    {
        const auto failed = TakeEvents<Planning::JobFailed>();
        CHECK(failed.size() == 1);
        return failed.empty() ? std::string() : failed.front().reason;
    }
};

} // namespace ACS::Acsd::Test
