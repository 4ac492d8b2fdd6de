
/* The row of the observer at rest at r > 1 (in Schwarzschild radii; INFINITY is allowed): ROW_LENGTH numbers, mixed from four
   rows of the atlas by Lagrange's cubic. At the ends of the atlas all four rows are inside it. Call it when r changes, not
   for each ray. */
static inline void $function_row(double r, float row[ROW_LENGTH]) {
    double u = 1.0 / r;
    double position = atan2(sqrt(u), sqrt(fmax(1.0 - u, 0.0))) / 1.5707963267948966 * (ROW_COUNT - 1);
    int first = (int)position - 1;
    if (first < 0) first = 0;
    if (first > ROW_COUNT - 4) first = ROW_COUNT - 4;
    double t = position - first;
    double weights[4] = {
        -(t - 1.0) * (t - 2.0) * (t - 3.0) / 6.0,
        t * (t - 2.0) * (t - 3.0) / 2.0,
        -t * (t - 1.0) * (t - 3.0) / 2.0,
        t * (t - 1.0) * (t - 2.0) / 6.0
    };
    for (int i = 0; i < ROW_LENGTH; i++) {
        double mixed = 0.0;
        for (int k = 0; k < 4; k++) {
            mixed += weights[k] * $function_numbers[ROW_LENGTH * (first + k) + i];
        }
        row[i] = (float)mixed;
    }
}
