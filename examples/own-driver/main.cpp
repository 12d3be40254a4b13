// acsd with a driver of its own: a small cart that speaks lines over TCP. The README has its protocol.

#include "CartAdapter.hpp"
#include <acs/acsd/LineRobotSetup.hpp>
#include <acs/acsd/RunAcsd.hpp>

namespace
{

using namespace ACS::Acsd; // NOLINT(google-build-using-namespace): an example reads better without the prefix

class CartDriver final : public IRobotDriver
{
public:
    [[nodiscard]] std::string_view GetName() const noexcept override
    {
        return "cart";
    }

    [[nodiscard]] std::unique_ptr<IRobotSetup> MakeSetupOrNull(const DrivenRobotConfig& config) const override
    {
        CartAdapter::Commands commands;
        for (const auto& [action, options] : config.actions)
        {
            commands[action] = options.GetWord("command", {"pick", "drop"});
        }
        return std::make_unique<LineRobotSetup>(
            RobotCapabilities{{ERobotType::LR}, {}, {}},
            ReadLineOptions(config.options),
            [commands] { return std::make_unique<CartAdapter>(commands); });
    }
};

} // namespace

int main(int argc, char** argv)
{
    return RunAcsd(argc, argv, MakeDrivers<CartDriver>());
}
