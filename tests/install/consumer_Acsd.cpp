// needs: Boost OpenSSL PostgreSQL SQLiteCpp Mosquitto spdlog tomlplusplus prometheus-cpp
#include <acs/acsd/LineRobotSetup.hpp>
#include <acs/acsd/RunAcsd.hpp>

#include <array>
#include <cstdio>
#include <string>

namespace
{

class Driver final : public ACS::Acsd::IRobotDriver
{
public:
    [[nodiscard]] std::string_view GetName() const noexcept override
    {
        return "consumer";
    }

    [[nodiscard]] std::unique_ptr<ACS::Acsd::IRobotSetup> MakeSetupOrNull(
        const ACS::Acsd::DrivenRobotConfig& config) const override
    {
        return std::make_unique<ACS::Acsd::LineRobotSetup>(
            ACS::Acsd::RobotCapabilities{},
            ACS::Acsd::ReadLineOptions(config.options),
            nullptr);
    }
};

} // namespace

int main()
{
    const auto options = ACS::Acsd::OptionTable::ReadText("url = \"tcp://10.0.0.7:4700\"", "cart.toml");
    ACS::Acsd::DrivenRobotConfig config{"LR01", ACS::Planning::ERobotType::LR, {}, options, {}};
    const std::string hint = Driver().MakeSetupOrNull(config)->GetCapabilities().connectionHint;
    std::puts(hint.c_str());

    std::string name = "acsd";
    std::string version = "--version";
    std::array<char*, 3> arguments{name.data(), version.data(), nullptr};
    const int exitCode = ACS::Acsd::RunAcsd(2, arguments.data(), ACS::Acsd::MakeDrivers<Driver>());
    return hint == "It is expected at 10.0.0.7:4700." ? exitCode : 1;
}
