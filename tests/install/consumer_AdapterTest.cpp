// needs: nothing
#include <acs/adapter_test/CheckAdapter.hpp>

#include <cstddef>
#include <cstdio>
#include <optional>
#include <string>
#include <string_view>

namespace
{

/// Never answers: that is a finding.
class SilentAdapter final : public ACS::Planning::IRobotAdapter
{
public:
    void Handle(
        const ACS::Planning::RobotCommand& /*command*/,
        ACS::Core::Now /*now*/,
        ACS::Planning::AdapterActions& /*out*/) override
    {
    }

    void OnTimer(
        ACS::Planning::AdapterTimerID /*timer*/,
        ACS::Core::Now /*now*/,
        ACS::Planning::AdapterActions& /*out*/) override
    {
    }

    [[nodiscard]] std::optional<std::string> GetRejectionReasonOrNull(std::string_view /*action*/) const override
    {
        return std::nullopt;
    }
};

class SilentBench final : public ACS::AdapterTest::IAdapterBench
{
    SilentAdapter _adapter;

public:
    [[nodiscard]] ACS::AdapterTest::BenchOptions GetOptions() const override
    {
        return {};
    }

    [[nodiscard]] ACS::Planning::StartJob MakeJob(std::size_t /*number*/) const override
    {
        return {};
    }

    void MakeRobot(ACS::AdapterTest::IVirtualTime& /*time*/) override
    {
    }

    [[nodiscard]] ACS::Planning::IRobotAdapter& MakeAdapter(ACS::AdapterTest::IAdapterHost& /*host*/) override
    {
        return _adapter;
    }

    void DestroyAdapter() override
    {
    }

    void DestroyRobot() override
    {
    }

    void OnAdapterCalled() override
    {
    }

    void SetLink(bool /*bUp*/) override
    {
    }

    void SetConduct(ACS::AdapterTest::EConduct /*conduct*/) override
    {
    }

    [[nodiscard]] ACS::AdapterTest::RobotTruth GetTruth() const override
    {
        return {};
    }
};

} // namespace

int main()
{
    SilentBench bench;
    const ACS::AdapterTest::ContractReport report = ACS::AdapterTest::CheckAdapter(bench);
    std::puts(report.Describe().c_str());
    return report.HasFinding(ACS::AdapterTest::ERule::LinkReported) ? 0 : 1;
}
