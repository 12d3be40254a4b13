#pragma once

#include "common/config/Url.hpp"
#include "config/ArmOptions.hpp"
#include "robots/DriveCheck.hpp"
#include "robots/JobMethods.hpp"
#include "robots/VehicleMaps.hpp"
#include <acs/plan/ERobotType.hpp>
#include <acs/plan/SiteMap.hpp>
#include <acs/vda5050/FactsheetMessage.hpp>
#include <acs/vda5050/Topic.hpp>

#include <chrono>
#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// A robot of the drivers `vda5050` and `vda5050_openstream`: its vehicle, and its arm if it has one.
struct VehicleConfig
{
    std::string robotID;
    VDA5050::VehicleAddress address;
    std::string protocolVersion = "2.0.0"; ///< "2.0.0" or "2.1.0"
    Planning::ERobotType type = Planning::ERobotType::LR;
    std::string vehicleTypeID;
    std::size_t portCount = 0;
    std::optional<VDA5050::FactsheetMessage> factsheet; ///< Of factsheet_file.
    std::vector<NeededMap> maps;                        ///< How the vehicle gets maps.
    std::string zoneSetID;                              ///< Of all orders; may be empty.
    std::chrono::milliseconds offlineAfter{15'000};
    std::chrono::milliseconds loadTimeout{10'000};
    std::optional<Apps::Url> armOrNull; ///< tcp://, Open Stream server of the arm's controller
    ArmOptions armOptions;
    JobMethods methods;                                                  ///< Of the actions of its type.
    std::shared_ptr<DriveCheck> drives = std::make_shared<DriveCheck>(); ///< Shared by its vehicle type.
    std::shared_ptr<const Planning::SiteMap> site;                       ///< Set if the configuration has no errors.
};

} // namespace ACS::Acsd
