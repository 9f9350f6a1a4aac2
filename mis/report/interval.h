#pragma once

namespace mis {

/// A figure and its 95 % interval. low and high are NaN where no interval is known; all three where
/// there is no figure.
struct Interval {
    double value = 0, low = 0, high = 0;
};

/// What is known of the logarithm of a positive figure: its value, standard error and degrees of
/// freedom (Student's t). se is NaN where nothing is known of the error; 0 where there is none.
struct LogEstimate {
    double value = 0, se = 0, dof = 0;
};

}  // namespace mis
