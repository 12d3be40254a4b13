#pragma once

namespace ACS::Apps
{

/// Raises the soft limit of open descriptors to the hard one: the usual 1024 are too few for a program that simulates
/// hundreds of machines. Does nothing if the system refuses.
void RaiseFileLimit();

} // namespace ACS::Apps
