#pragma once

#include "robots/ArmRelay.hpp"
#include "robots/NumberTemplate.hpp"
#include "robots/ParameterTemplate.hpp"
#include <acs/plan/EngineOptions.hpp>

#include <cstdint>
#include <string>
#include <vector>

namespace ACS::Acsd
{

/// A parameter of a vehicle's action.
struct VehicleParameter
{
    std::string key;
    ParameterTemplate value;
    bool bDefault = false; ///< Not configured: left out if the factsheet does not list it.
};

/// A value that is written to a relay before the arm's program starts.
struct ArmInputTemplate
{
    ArmRelay relay;
    NumberTemplate value;
};

/// How a robot does an action: by an action of the vehicle or by a program of the arm.
struct JobMethod
{
    std::string vehicleAction;                     ///< VDA5050 actionType; empty: the arm does it.
    std::uint32_t armProgram = 0;                  ///< 0: the vehicle does it.
    std::vector<VehicleParameter> parameters = {}; ///< Of the vehicle's action.
    std::vector<ArmInputTemplate> armInputs = {};  ///< Written before the program starts, in this order.
    Planning::EActionEffect effect = Planning::EActionEffect::None;
};

} // namespace ACS::Acsd
