/* Prints the deflection angle for view angles from 10 to 180 degrees at the radius that is given, 10 by default. */

#include <stdio.h>
#include <stdlib.h>

#include "lensbake.h"

int main(int count, char **arguments) {
    double r = count > 1 ? atof(arguments[1]) : 10.0;
    if (!(r > 1.0)) {
        fprintf(stderr, "example: the radius must be above 1, in Schwarzschild radii\n");
        return 2;
    }
    float row[128];
    lensbake_row(r, row);
    for (int degrees = 10; degrees <= 180; degrees += 10) {
        float theta = (float)degrees * 0.017453293f;
        float bend = lensbake_bend(cosf(theta), sinf(theta), lensbake_shadow_edge((float)r), row);
        if (bend > 1e3f) {
            printf("%3d  captured\n", degrees);
        } else {
            printf("%3d  %.7f rad\n", degrees, (double)bend);
        }
    }
    return 0;
}
