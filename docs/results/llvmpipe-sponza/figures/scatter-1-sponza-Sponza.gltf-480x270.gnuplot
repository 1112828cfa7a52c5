# gnuplot -e "set terminal pdfcairo enhanced size 7.2,4.4 font 'sans-serif,8' fontscale 0.75; set output 'scatter-1-sponza-Sponza.gltf-480x270.pdf'" scatter-1-sponza-Sponza.gltf-480x270.gnuplot
set encoding utf8
set border 3 linecolor rgb '#555555'
set grid linetype 1 linewidth 0.5 linecolor rgb '#DDDDDD'
set key Left reverse samplen 1 spacing 1.1
set logscale x
set xrange [5.945703:451.5518563724999]
set xtics nomirror out ('' 6 1, '' 7 1, '' 8 1, '' 9 1, '10' 10, '20' 20, '' 30 1, '' 40 1, '50' 50, '' 60 1, '' 70 1, '' 80 1, '' 90 1, '100' 100, '200' 200, '' 300 1, '' 400 1)
unset logscale y
set yrange [0:0.15887126795823947]
set ytics nomirror out ('0.00' 0, '0.05' 0.05, '0.10' 0.1, '0.15' 0.15000000000000002)
set bars 0
set lmargin at screen 0.085
set rmargin at screen 0.64
set tmargin at screen 0.97
set bmargin at screen 0.12
set xlabel 'milliseconds'
set ylabel 'RMSE of visibility, matched'
set label 'alchemy' at screen 0.6650, 0.9650 point pointtype 7 pointsize 0.7 linecolor rgb '#0072B2' offset char 1, 0 font ',7'
set label 'blizzard\_corrected' at screen 0.6650, 0.9290 point pointtype 5 pointsize 0.7 linecolor rgb '#D55E00' offset char 1, 0 font ',7'
set label 'crytek' at screen 0.6650, 0.8930 point pointtype 9 pointsize 0.7 linecolor rgb '#009E73' offset char 1, 0 font ',7'
set label 'gtao' at screen 0.6650, 0.8570 point pointtype 13 pointsize 0.7 linecolor rgb '#CC79A7' offset char 1, 0 font ',7'
set label 'hbao' at screen 0.6650, 0.8210 point pointtype 11 pointsize 0.7 linecolor rgb '#E69F00' offset char 1, 0 font ',7'
set label 'hbao\_deinterleaved' at screen 0.6650, 0.7850 point pointtype 15 pointsize 0.7 linecolor rgb '#56B4E9' offset char 1, 0 font ',7'
set label 'hbao\_plus' at screen 0.6650, 0.7490 point pointtype 1 pointsize 0.7 linecolor rgb '#000000' offset char 1, 0 font ',7'
set label 'multi\_scale' at screen 0.6650, 0.7130 point pointtype 2 pointsize 0.7 linecolor rgb '#0072B2' offset char 1, 0 font ',7'
set label 'proxy\_spheres' at screen 0.8300, 0.9650 point pointtype 5 pointsize 0.7 linecolor rgb '#009E73' offset char 1, 0 font ',7'
set label 'ray\_march' at screen 0.8300, 0.9290 point pointtype 9 pointsize 0.7 linecolor rgb '#CC79A7' offset char 1, 0 font ',7'
set label 'sao' at screen 0.8300, 0.8930 point pointtype 13 pointsize 0.7 linecolor rgb '#E69F00' offset char 1, 0 font ',7'
set label 'starcraft' at screen 0.8300, 0.8570 point pointtype 11 pointsize 0.7 linecolor rgb '#56B4E9' offset char 1, 0 font ',7'
set label 'vao' at screen 0.8300, 0.8210 point pointtype 15 pointsize 0.7 linecolor rgb '#000000' offset char 1, 0 font ',7'
set label 'vao\_plus\_plus' at screen 0.8300, 0.7850 point pointtype 1 pointsize 0.7 linecolor rgb '#0072B2' offset char 1, 0 font ',7'
set label 'visibility\_bitmask' at screen 0.8300, 0.7490 point pointtype 2 pointsize 0.7 linecolor rgb '#D55E00' offset char 1, 0 font ',7'
set label 'volumetric\_obscurance' at screen 0.8300, 0.7130 point pointtype 7 pointsize 0.7 linecolor rgb '#009E73' offset char 1, 0 font ',7'
set label '1  starcraft downscale=2 samples=8' at screen 0.6570, 0.6570 font ',6.5'
set label '2  bitmask-half low' at screen 0.6570, 0.6210 font ',6.5'
set label '3  gtao-half medium' at screen 0.6570, 0.5850 font ',6.5'
set label '4  bitmask-half medium' at screen 0.6570, 0.5490 font ',6.5'
set label '5  gtao-half high' at screen 0.6570, 0.5130 font ',6.5'
set label '6  bitmask-half high' at screen 0.6570, 0.4770 font ',6.5'
set label '7  gtao high' at screen 0.6570, 0.4410 font ',6.5'
set label '8  bitmask high' at screen 0.6570, 0.4050 font ',6.5'
set label '9  bitmask ultra' at screen 0.6570, 0.3690 font ',6.5'
set label '1' at graph 0.1030, 0.7004 center font ',6.5' front
set label '2' at graph 0.1393, 0.5302 center font ',6.5' front
set label '3' at graph 0.1797, 0.5227 center font ',6.5' front
set label '4' at graph 0.1700, 0.4823 center font ',6.5' front
set arrow from graph 0.2004, 0.5278 to graph 0.1761, 0.4953 nohead linewidth 0.5 linecolor rgb '#999999'
set label '5' at graph 0.2254, 0.4818 center font ',6.5' front
set label '6' at graph 0.2356, 0.4502 center font ',6.5' front
set arrow from graph 0.2660, 0.4958 to graph 0.2416, 0.4632 nohead linewidth 0.5 linecolor rgb '#999999'
set label '7' at graph 0.4473, 0.4435 center font ',6.5' front
set label '8' at graph 0.4506, 0.3963 center font ',6.5' front
set arrow from graph 0.4932, 0.4636 to graph 0.4567, 0.4094 nohead linewidth 0.5 linecolor rgb '#999999'
set label '9' at graph 0.6478, 0.4364 center font ',6.5' front
$front << END
10.0504015 0.15887126795823947
10.0504015 0.11506985637994836
11.76448325 0.08801915829584295
14.008077499999999 0.08683768352532178
14.161393 0.08385310765121586
17.0790105 0.0803311368037942
18.809915750000002 0.07876394306801271
44.6446125 0.07425815303350956
50.3116985 0.0736506616050905
106.3530605 0.0731233043479623
451.5518563724999 0.0731233043479623
END
$t0 << END
30.532064499999997 0.11401711407830059 26.3711126 38.516547349999996
106.93782399999999 0.110816628362314 86.54312064999999 115.46696515
END
$t1 << END
49.828618000000006 0.09403597892176278 40.0146331 58.052640000000004
END
$t2 << END
26.08480325 0.14371679892624853 20.441449925 32.60046925
END
$t3 << END
11.852224 0.08938250626992272 8.1983708 19.585316999999996
14.008077499999999 0.08683768352532178 10.436555850000001 20.764437949999998
17.0790105 0.0803311368037942 13.432674225 26.171183649999996
28.4992875 0.08377623775982039 25.72235285 36.647137825
38.60887675 0.08076036532723038 29.4526539 46.893134575
44.6446125 0.07425815303350956 36.934377549999994 64.652603425
82.69749925 0.07392479724004548 81.3337123 93.82372414999999
END
$t4 << END
15.4612445 0.09892679721918486 11.5842541 26.072423249999993
22.850061500000002 0.09799027689460692 20.304600299999997 30.759952799999994
41.4438885 0.09262241995882199 35.0618718 48.9203205
62.22056225 0.09174382371053394 59.86656947499999 71.35628220000001
END
$t5 << END
86.84073500000001 0.10043023087639705 79.03227875 89.58881885
END
$t6 << END
77.446688 0.10173156340562392 71.42251325000001 81.49624790000001
END
$t7 << END
105.219787 0.08851159064903687 88.60995894999999 109.14816235
END
$t9 << END
376.2327675 0.11683955251974992 355.37028284999997 392.65378814999997
END
$t10 << END
110.72062550000001 0.1152025256611012 96.9925313 118.7475059
END
$t11 << END
111.69824173250001 0.09338299434745098 103.2676060325 127.3300415825
END
$t12 << END
10.0504015 0.11506985637994836 6.8375584499999995 17.012510299999995
13.05986075 0.11152915943622584 8.200853975 21.681192124999992
16.293515 0.10619754857399537 12.539605000000002 25.89482575
20.34405875 0.1087828282343568 17.172287175 25.593338324999998
29.628692500000003 0.10469126862172001 22.2838417 41.15808204999999
44.558578 0.09817293114111991 38.0728465 58.8958715
END
$t13 << END
42.5108695 0.15130596948403757 35.758813700000005 44.0540125
END
$t14 << END
21.1975945 0.1256795198085625 17.428993374999997 31.46335884999999
24.12571275 0.11977336092159091 21.480222250000004 34.071662125
33.4703295 0.11973312261733947 26.22174475 45.620191000000005
END
$t15 << END
11.76448325 0.08801915829584295 8.6031594 18.440739874999995
14.161393 0.08385310765121586 10.327135625 23.006900125
18.809915750000002 0.07876394306801271 15.95565885 34.87185087499999
31.06463925 0.08319729154633397 24.421252574999997 41.81539014999999
40.07984625 0.08139066494625918 38.09187779999999 61.6141127
50.3116985 0.0736506616050905 48.434465125 59.958987
106.3530605 0.0731233043479623 92.71709164999999 117.09858574999998
END
$t16 << END
14.716745 0.12133337597846448 10.337083450000002 21.191644625
38.21579625 0.11796697707329717 32.53499157499999 48.642684675
END
plot $front using 1:2 with steps linewidth 1.5 linecolor rgb '#333333' notitle, \
  $t0 using 1:2 with lines linewidth 0.5 linecolor rgb '#0072B2' notitle, \
  $t0 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#0072B2' notitle, \
  $t0 using 1:2 with points pointtype 7 pointsize 0.7 linecolor rgb '#0072B2' notitle, \
  $t1 using 1:2 with lines linewidth 0.5 linecolor rgb '#D55E00' notitle, \
  $t1 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#D55E00' notitle, \
  $t1 using 1:2 with points pointtype 5 pointsize 0.7 linecolor rgb '#D55E00' notitle, \
  $t2 using 1:2 with lines linewidth 0.5 linecolor rgb '#009E73' notitle, \
  $t2 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#009E73' notitle, \
  $t2 using 1:2 with points pointtype 9 pointsize 0.7 linecolor rgb '#009E73' notitle, \
  $t3 using 1:2 with lines linewidth 0.5 linecolor rgb '#CC79A7' notitle, \
  $t3 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#CC79A7' notitle, \
  $t3 using 1:2 with points pointtype 13 pointsize 0.7 linecolor rgb '#CC79A7' notitle, \
  $t4 using 1:2 with lines linewidth 0.5 linecolor rgb '#E69F00' notitle, \
  $t4 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#E69F00' notitle, \
  $t4 using 1:2 with points pointtype 11 pointsize 0.7 linecolor rgb '#E69F00' notitle, \
  $t5 using 1:2 with lines linewidth 0.5 linecolor rgb '#56B4E9' notitle, \
  $t5 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#56B4E9' notitle, \
  $t5 using 1:2 with points pointtype 15 pointsize 0.7 linecolor rgb '#56B4E9' notitle, \
  $t6 using 1:2 with lines linewidth 0.5 linecolor rgb '#000000' notitle, \
  $t6 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#000000' notitle, \
  $t6 using 1:2 with points pointtype 1 pointsize 0.7 linecolor rgb '#000000' notitle, \
  $t7 using 1:2 with lines linewidth 0.5 linecolor rgb '#0072B2' notitle, \
  $t7 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#0072B2' notitle, \
  $t7 using 1:2 with points pointtype 2 pointsize 0.7 linecolor rgb '#0072B2' notitle, \
  $t9 using 1:2 with lines linewidth 0.5 linecolor rgb '#009E73' notitle, \
  $t9 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#009E73' notitle, \
  $t9 using 1:2 with points pointtype 5 pointsize 0.7 linecolor rgb '#009E73' notitle, \
  $t10 using 1:2 with lines linewidth 0.5 linecolor rgb '#CC79A7' notitle, \
  $t10 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#CC79A7' notitle, \
  $t10 using 1:2 with points pointtype 9 pointsize 0.7 linecolor rgb '#CC79A7' notitle, \
  $t11 using 1:2 with lines linewidth 0.5 linecolor rgb '#E69F00' notitle, \
  $t11 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#E69F00' notitle, \
  $t11 using 1:2 with points pointtype 13 pointsize 0.7 linecolor rgb '#E69F00' notitle, \
  $t12 using 1:2 with lines linewidth 0.5 linecolor rgb '#56B4E9' notitle, \
  $t12 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#56B4E9' notitle, \
  $t12 using 1:2 with points pointtype 11 pointsize 0.7 linecolor rgb '#56B4E9' notitle, \
  $t13 using 1:2 with lines linewidth 0.5 linecolor rgb '#000000' notitle, \
  $t13 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#000000' notitle, \
  $t13 using 1:2 with points pointtype 15 pointsize 0.7 linecolor rgb '#000000' notitle, \
  $t14 using 1:2 with lines linewidth 0.5 linecolor rgb '#0072B2' notitle, \
  $t14 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#0072B2' notitle, \
  $t14 using 1:2 with points pointtype 1 pointsize 0.7 linecolor rgb '#0072B2' notitle, \
  $t15 using 1:2 with lines linewidth 0.5 linecolor rgb '#D55E00' notitle, \
  $t15 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#D55E00' notitle, \
  $t15 using 1:2 with points pointtype 2 pointsize 0.7 linecolor rgb '#D55E00' notitle, \
  $t16 using 1:2 with lines linewidth 0.5 linecolor rgb '#009E73' notitle, \
  $t16 using 1:2:3:4 with xerrorbars pointtype 7 pointsize 0 linewidth 0.7 linecolor rgb '#009E73' notitle, \
  $t16 using 1:2 with points pointtype 7 pointsize 0.7 linecolor rgb '#009E73' notitle
